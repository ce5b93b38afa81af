#pragma once

#include "core/lights/spherical_polygon.h"
#include "core/surface_point.h"

namespace photopic {

/// Squared distance of the middle, in extents, beyond which solid angle and area are sampled alike.
inline constexpr float kFar2 = 1.0f;
/// Squared height above the plane, likewise, below which the solid angle is lost in rounding; as it is where
/// the height itself may be nothing but rounding.
inline constexpr float kTouching2 = 1e-11f;

/// Where an area light is seen from: one AreaLight (T float), or AreaLightLanes.
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
    const T distance2 = dot(to_middle, to_middle), depth = abs(height);
    return (distance2 <= kFar2 * extent2) & (depth * depth >= kTouching2 * extent2) & (depth >= rounding);
  }

  template <typename Light>
  BasicSphericalPolygon<T> outline(const Light& light) const {
    const Vec3<T> second = to_vertex + light.edge1, last = to_vertex + light.edge2;
    const T volume = abs(height) * light.area;
    return {{to_vertex, second, select(light.parallelogram, second + light.edge2, last), last},
            {select(light.parallelogram, volume, 2.0f * volume), select(light.parallelogram, volume, T{})}};
  }

  /// Density of directions where area is sampled [1/sr]. @param distance to the point [m]
  template <typename Light>
  T pdf_by_area(const Light& light, T distance) const {
    return (distance * distance / light.area) * (distance / abs(height));  // the cube might overflow
  }

  /// Where a shadow ray ends: a little in front of the point.
  template <typename Light>
  Vec3<T> end(const Light& light, Vec3<T> to_point) const {
    return from + to_point + light.normal * select(height < 0.0f, rounding, -rounding);
  }
};

}  // namespace photopic
