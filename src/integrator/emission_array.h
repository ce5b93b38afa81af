#pragma once

#include <vector>

#include "core/compiled_sampler.h"

namespace photopic {

/// The scene's emission spectra at the wavelengths of many paths. Of few lamps they are looked up as a path
/// begins, together; of many each when it is met.
template <int N>
class EmissionArray {
 public:
  /// @param count of the spectra that the sampler was made for
  EmissionArray(std::size_t paths, std::size_t count, const CompiledSampler& sampler)
      : sampler_(sampler),
        count_(count),
        values_(is_ready() ? paths * count : 0),
        places_(is_ready() ? 0 : paths) {}

  std::size_t count() const { return count_; }

  /// Of paths that begin. @param first sampler.look_up(drawn, 0)[3], which is at hand
  PHOTOPIC_INLINE void set(const Packet& packet, const WavelengthLanes<N>& drawn,
                           const SpectrumLanes<N>& first) {
    if (!is_ready()) return set_places(packet, drawn);
    if (count_ > 0) set(packet, 0, first);
    for (std::size_t e = 1; e < count_; e += 4) {
      const auto four = sampler_.look_up(drawn, 3 + e);
      for (std::size_t i = 0; i < 4 && e + i < count_; ++i) set(packet, e + i, four[i]);
    }
  }

  /// @param k of Scene::emission_spectra
  SampledSpectrum<N> operator()(std::uint32_t slot, int k) const {
    const auto e = static_cast<std::size_t>(k);
    return is_ready() ? values_[slot * count_ + e] : sampler_.look_up(places_[slot], 3 + e);
  }

  /// Of each of a packet's paths another.
  PHOTOPIC_INLINE SpectrumLanes<N> gather(const Packet& packet, IntLanes spectra) const {
    if (is_ready())
      return gather_spectra<N>(
          [&](int i) { return &values_[packet[i] * count_ + static_cast<std::size_t>(spectra[i])]; });
    LaneSpectra<N> values;
    for (int i = 0; i < kLanes; ++i)
      values[static_cast<std::size_t>(i)] = (*this)(packet[i], lane(spectra, i));
    return to_lanes<N>(values);
  }

 private:
  /// From more spectra on, a path meets too few to look up all.
  static constexpr std::size_t kMostAtOnce = 12;
  bool is_ready() const { return count_ <= kMostAtOnce; }

  PHOTOPIC_INLINE void set(const Packet& packet, std::size_t e, const SpectrumLanes<N>& values) {
    const auto by_path = by_lane(values);
    for (int i = 0; i < packet.count; ++i)
      values_[packet[i] * count_ + e] = by_path[static_cast<std::size_t>(i)];
  }
  void set_places(const Packet& packet, const WavelengthLanes<N>& drawn) {
    for (int i = 0; i < packet.count; ++i) places_[packet[i]] = drawn.place(i);
  }

  const CompiledSampler& sampler_;
  std::size_t count_;
  std::vector<SampledSpectrum<N>> values_;
  std::vector<WavelengthPlaces<N>> places_;  ///< where they are looked up when met
};

}  // namespace photopic
