#pragma once

#include <span>

#include "integrator/integrator.h"
#include "integrator/media.h"
#include "integrator/path_start.h"

namespace photopic {

/// The oracle: one path at a time, only BSDF sampling finds light, no roulette. Slow, and short enough to be
/// seen right.
template <int N>
class NaivePathTracer {
 public:
  NaivePathTracer(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                  const RenderOptions& options)
      : scene_(scene),
        sampler_(wavelengths),
        options_(options),
        camera_media_(media_at(scene, scene.scene.camera.position)) {}

  void trace(std::span<const PathKey> paths, Film& film);

  const RenderStats& stats() const { return stats_; }

 private:
  Xyz trace(const PathKey& path);

  const PreparedScene& scene_;
  const WavelengthSampler& sampler_;
  const RenderOptions& options_;
  PathMedia camera_media_;
  RenderStats stats_;
};

}  // namespace photopic
