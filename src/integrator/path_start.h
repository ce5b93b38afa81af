#pragma once

#include <cstdint>

#include "core/camera.h"
#include "core/sample_sequence.h"

namespace photopic {

/// One sample of one pixel.
struct PathKey {
  std::uint32_t pixel;  ///< y·width + x
  std::uint32_t sample;
};

/// Which number of the sample stream drives what. Each entry is a dimension of its own: one number or a pair.
enum Dimension : std::uint32_t { kFilm, kWavelength, kLens, kFirstBounce };
enum BounceDimension : std::uint32_t {
  kBsdfChoice,
  kLightChoice,
  kLightPoint,
  kBsdfLobe,
  kBsdfDirection,
  kRoulette,
  kPerBounce
};

inline std::uint32_t bounce_dimension(int depth, BounceDimension which) {
  return kFirstBounce + static_cast<std::uint32_t>(depth) * kPerBounce + which;
}

/// The camera ray of a sample: box filter over the pixel.
inline Ray camera_ray(const Camera& camera, std::uint32_t pixel, const SampleStream& stream) {
  const auto width = static_cast<std::uint32_t>(camera.width);
  const Sample2d u = stream.get_2d(kFilm);
  const float x = static_cast<float>(pixel % width) + u.x, y = static_cast<float>(pixel / width) + u.y;
  return camera.has_lens() ? camera.ray(x, y, stream.get_2d(kLens)) : camera.ray(x, y);
}

/// The same of 16.
inline RayLanes camera_rays(const Camera& camera, UintLanes pixel, const SampleStreamLanes& stream) {
  const auto width = static_cast<std::uint32_t>(camera.width);
  const Sample2dLanes u = stream.get_2d(kFilm);
  const UintLanes row = pixel / width;
  const Lanes x = to_float(pixel - row * width) + u.x, y = to_float(row) + u.y;
  if (!camera.has_lens()) return camera.ray(x, y);
  const Sample2dLanes u_lens = stream.get_2d(kLens);
  RayLanes rays;
  for (int i = 0; i < kLanes; ++i) {
    const Ray ray = camera.ray(x[i], y[i], lane(u_lens, i));
    set_lane(rays.origin, i, ray.origin), set_lane(rays.direction, i, ray.direction);
  }
  return rays;
}

}  // namespace photopic
