#pragma once

#include "core/lights/spherical_polygon.h"
#include "core/surface_point.h"

namespace photopic {

/// Points of area lights: of one AreaLight (T float), or of 16 as AreaLightLanes.

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

/// LightSample's part that is geometry.
template <typename T>
struct AreaSample {
  using Mask = decltype(T{} < T{});
  Mask reached;  ///< else the rest means nothing
  Vec3<T> direction, end;
  T distance, pdf;
  Mask in_first;  ///< the point is on the triangle of edge1, should the light have two
};

template <typename T, typename Light>
AreaSample<T> sample_by_area(const Light& light, const LightView<T>& view, BasicSample2d<T> u) {
  const BasicSample2d<T> folded = sample_triangle(u);
  const T x = select(light.parallelogram, u.x, folded.x), y = select(light.parallelogram, u.y, folded.y);
  const Vec3<T> to_point = view.to_vertex + light.edge1 * x + light.edge2 * y;
  const T distance = length(to_point);
  return {view.height != 0.0f,
          to_point * (1.0f / distance),
          view.end(light, to_point),
          distance,
          view.pdf_by_area(light, distance),
          x > y};
}

template <typename T, typename Light>
AreaSample<T> sample_by_solid_angle(const Light& light, const LightView<T>& view, BasicSample2d<T> u) {
  const BasicSphericalPolygon<T> outline = view.outline(light);
  const auto way = outline.sample(u);
  const T cosine = dot(light.normal, way.direction), distance = view.height / cosine;
  const T solid_angle = outline.solid_angle();
  const typename AreaSample<T>::Mask reached = (cosine * view.height > 0.0f) & (solid_angle > 0.0f);
  return {reached,  way.direction,      view.end(light, way.direction * distance),
          distance, 1.0f / solid_angle, way.in_first};
}

/// A point of a light that shines to where it is seen from.
template <typename T, typename Light>
AreaSample<T> sample_area_light(const Light& light, Vec3<T> from, BasicSample2d<T> u) {
  const LightView<T> view(light, from);
  AreaSample<T> s = sample_by_area(light, view, u);
  if (const auto looms = view.looms(light); any(looms)) {
    const AreaSample<T> near = sample_by_solid_angle(light, view, u);
    s = {select(looms, near.reached, s.reached), select(looms, near.direction, s.direction),
         select(looms, near.end, s.end),         select(looms, near.distance, s.distance),
         select(looms, near.pdf, s.pdf),         select(looms, near.in_first, s.in_first)};
  }
  s.reached = s.reached & ((view.height < 0.0f) | light.double_sided);
  return s;
}

}  // namespace photopic
