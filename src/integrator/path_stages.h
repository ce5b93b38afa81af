#pragma once

#include <span>

#include "integrator/integrator.h"
#include "integrator/non_finite_watch.h"
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
    s.split_paths = shading_.split_paths() - splits_seen_twice_;
    return s;
  }

 private:
  /// Every stage of the paths, up to what each has gathered.
  void advance(std::span<const PathKey> paths);
  void start(std::span<const PathKey> paths);
  void choose_wavelengths();
  void leave_camera();
  void intersect();
  void escape();
  void absorb_and_emit();
  void sort_by_bsdf(int depth);
  void trace_shadow_rays();
  void roulette(int depth);
  bool is_lost(std::size_t slot) const;
  void finish(std::span<const PathKey> paths, Film& film);
  void count_non_finite(std::span<const PathKey> paths);

  const PreparedScene& scene_;
  const WavelengthSampler& sampler_;
  const RenderOptions& options_;
  PathBatch<N> batch_;
  ShadingStage<N> shading_;
  RenderStats stats_;
  std::uint64_t splits_seen_twice_ = 0;
  NonFiniteWatch<N>* watch_ = nullptr;  ///< set while count_non_finite() traces paths once more
};

}  // namespace photopic
