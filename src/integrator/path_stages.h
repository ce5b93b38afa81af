#pragma once

#include <span>

#include "integrator/integrator.h"
#include "integrator/path_batch.h"
#include "integrator/shading_stage.h"

namespace photopic {

/// Advances batches of paths from the camera to their ends, one stage for all of them at a time.
template <int N>
class PathTracer {
 public:
  PathTracer(const PreparedScene& scene, const WavelengthSampler& wavelengths, const RenderOptions& options);

  /// Traces the paths and adds them to the film in the order given. At most options.batch_size of them.
  void trace(std::span<const PathKey> paths, Film& film);

  RenderStats stats() const {
    RenderStats s = stats_;
    s.split_paths = shading_.split_paths();
    return s;
  }

 private:
  void start(std::span<const PathKey> paths);
  void choose_wavelengths();
  void leave_camera();
  void intersect();
  void escape();
  void absorb_and_emit();
  void travel(std::uint32_t slot);
  void pass_hidden_surfaces();
  void sort_by_bsdf(int depth);
  void trace_shadow_rays();
  void roulette(int depth);
  void finish(std::size_t count, Film& film);

  const PreparedScene& scene_;
  const WavelengthSampler& sampler_;
  const RenderOptions& options_;
  PathBatch<N> batch_;
  ShadingStage<N> shading_;
  PathMedia camera_media_;  ///< around the camera
  RenderStats stats_;
};

}  // namespace photopic
