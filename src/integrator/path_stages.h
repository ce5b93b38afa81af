#pragma once

#include <span>

#include "integrator/integrator.h"
#include "integrator/path_batch.h"
#include "integrator/vertex.h"
#include "spectral/wavelength_table.h"

namespace photopic {

/// Advances batches of paths from the camera to their ends, one stage for all of them at a time.
template <int N>
class PathTracer {
 public:
  /// @param table of the scene's emissions and the observer
  PathTracer(const PreparedScene& scene, const WavelengthSampler& wavelengths, const RenderOptions& options,
             const WavelengthTable& table);

  /// Traces the paths and adds them to the film in the order given. At most options.batch_size of them.
  void trace(std::span<const PathKey> paths, Film& film);

  const RenderStats& stats() const { return stats_; }

 private:
  void start(std::span<const PathKey> paths);
  void choose_wavelengths();
  void leave_camera();
  void intersect();
  void escape();
  void absorb_and_emit();
  void sort_by_bsdf(int depth);
  template <typename Bsdf>
  void shade(std::span<const std::uint32_t> slots, int depth);
  void weigh_spectra(std::uint32_t slot);
  SampledSpectrum<N> lamp_tint(std::uint32_t slot, const LightSample& light) const;
  template <typename Bsdf>
  void sample_light(std::uint32_t slot, int depth, const Vertex<N, Bsdf>& vertex);
  template <typename Bsdf>
  void sample_direction(std::uint32_t slot, int depth, const Vertex<N, Bsdf>& vertex);
  void trace_shadow_rays();
  void roulette(int depth);
  void finish(std::size_t count, Film& film);

  const PreparedScene& scene_;
  const WavelengthSampler& sampler_;
  const RenderOptions& options_;
  const WavelengthTable& table_;
  PathBatch<N> batch_;
  RenderStats stats_;
};

}  // namespace photopic
