#pragma once

#include <optional>
#include <vector>

#include "integrator/non_finite.h"
#include "integrator/path_batch.h"
#include "integrator/stage_watch.h"

namespace photopic {

/// Looks at paths that are traced once more, after each stage: where does each cease to be finite?
template <int N>
class NonFiniteWatch : public StageWatch {
 public:
  /// @param count of paths, in the first slots of the batch
  NonFiniteWatch(const PathBatch<N>& batch, std::size_t count) : batch_(batch), cause_(count) {}

  void after(Stage stage) override {
    if (stage == kStageStart) after_start();
    if (stage == kStageEmit) after_emission();
    if (stage == kStageShadow) after_scattering();
  }

  NonFiniteCounts counts() const {
    NonFiniteCounts counts;
    for (const auto& cause : cause_) counts.add(cause.value_or(NonFiniteCause::sum));
    return counts;
  }

 private:
  void after_start() {
    note([&](std::uint32_t slot) -> std::optional<NonFiniteCause> {
      if (!wavelengths_are_finite(slot)) return NonFiniteCause::wavelengths;
      if (!ray_is_traceable(slot)) return NonFiniteCause::camera;
      return {};
    });
  }
  void after_emission() {
    note([&](std::uint32_t slot) -> std::optional<NonFiniteCause> {
      if (!is_finite(batch_.throughput[slot])) return NonFiniteCause::absorption;
      if (!is_finite(batch_.radiance[slot])) return NonFiniteCause::emission;
      return {};
    });
  }
  void after_scattering() {
    note([&](std::uint32_t slot) -> std::optional<NonFiniteCause> {
      if (!is_finite(batch_.radiance[slot])) return NonFiniteCause::light_sample;
      if (!is_finite(batch_.throughput[slot]) || !ray_is_traceable(slot)) return NonFiniteCause::scattering;
      return {};
    });
  }

  template <typename Find>
  void note(Find find) {
    for (std::uint32_t slot = 0; slot < cause_.size(); ++slot)
      if (!cause_[slot]) cause_[slot] = find(slot);
  }

  static bool is_finite(const SampledSpectrum<N>& s) {
    for (int j = 0; j < N; ++j)
      if (!std::isfinite(s.v[j])) return false;
    return true;
  }
  bool ray_is_traceable(std::uint32_t slot) const { return is_traceable(batch_.rays[slot]); }
  bool wavelengths_are_finite(std::uint32_t slot) const {
    const PathWavelengths<N>& w = batch_.wavelengths[slot];
    bool finite = is_finite(w.lambda);
    for (const SampledSpectrum<N>& weight : w.xyz_per_radiance) finite = finite && is_finite(weight);
    for (std::size_t k = 0; k < batch_.emission.count(); ++k)
      finite = finite && is_finite(batch_.emission(slot, static_cast<int>(k)));
    return finite;
  }

  const PathBatch<N>& batch_;
  std::vector<std::optional<NonFiniteCause>> cause_;  ///< of each slot
};

}  // namespace photopic
