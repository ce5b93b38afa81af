#pragma once

#include "core/math.h"
#include "core/sampling.h"
#include "core/surface_point.h"

namespace photopic {

/// What AreaLight and AreaLightLanes do alike: T is float or Lanes, a Light has a vertex, edges, a normal …

/// Squared distance of the middle, in extents, beyond which solid angle and area are sampled alike.
inline constexpr float kFar2 = 1.0f;
/// Squared height above the plane, likewise, below which the solid angle is lost in rounding; as it is where
/// the height itself may be nothing but rounding.
inline constexpr float kTouching2 = 1e-11f;

/// Where a light is seen from.
template <typename T>
struct LightView {
  Vec3<T> from;
  Vec3<T> to_vertex;
  T height;    ///< of the plane in front of the viewer, along the normal: negative in front of the light [m]
  T rounding;  ///< bound on what rounding does to that, and to a ray to the light; it grows with coordinates
               ///< [m]

  template <typename Light>
  LightView(const Light& light, Vec3<T> from_point)
      : from(from_point),
        to_vertex(light.vertex - from),
        height(dot(light.normal, to_vertex)),
        rounding(max(T{} + light.error, kPositionError * max_abs(from))) {}

  /// Whether solid angle is sampled, the light being neither far nor all but touched.
  template <typename Light>
  auto looms(const Light& light) const {
    const T share = select(light.parallelogram, T{} + 0.5f, T{} + 1.0f / 3.0f);
    const Vec3<T> to_middle = to_vertex + (light.edge1 + light.edge2) * share;
    const T extent2 = max(dot(light.edge1, light.edge1), dot(light.edge2, light.edge2));
    return (dot(to_middle, to_middle) <= kFar2 * extent2) & (height * height >= kTouching2 * extent2) &
           (abs(height) >= rounding);
  }

  /// Density of directions where area is sampled [1/sr]. @param distance to the point [m]
  template <typename Light>
  T pdf_by_area(const Light& light, T distance) const {
    return distance * distance * distance / (abs(height) * light.area);
  }

  /// Where a shadow ray ends: a little in front of the point.
  template <typename Light>
  Vec3<T> end(const Light& light, Vec3<T> to_point) const {
    return from + to_point + light.normal * select(height < 0.0f, rounding, -rounding);
  }
};

/// Along the edges of a light, uniform on its area. Where x exceeds y, on a parallelogram, it is the half on
/// edge1.
template <typename T, typename Light>
BasicSample2d<T> sample_area(const Light& light, BasicSample2d<T> u) {
  const BasicSample2d<T> folded = sample_triangle(u);
  return {select(light.parallelogram, u.x, folded.x), select(light.parallelogram, u.y, folded.y)};
}

}  // namespace photopic
