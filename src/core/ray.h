#pragma once

#include "core/math.h"

namespace photopic {

/// A ray. t counts in lengths of the direction: in metres, it being a unit vector, but for shadow rays, whose
/// direction may lead all the way to the light.
template <typename T>
struct BasicRay {
  Vec3<T> origin;  ///< relative to Scene::origin [m]
  Vec3<T> direction;
};
using Ray = BasicRay<float>;
using RayLanes = BasicRay<Lanes>;

/// How far coordinates of rays may go [m]: Embree takes 1.8e18, of instances in the space of their prototype.
inline constexpr float kFarthest = 3e13f;

/// Whether a ray can be traced: it is finite and not too far away.
template <typename T>
auto is_traceable(const BasicRay<T>& ray) {
  const auto extent = [](const Vec3<T>& a) { return abs(a.x) + abs(a.y) + abs(a.z); };
  return extent(ray.origin) + extent(ray.direction) < kFarthest;
}

}  // namespace photopic
