#pragma once

#include <span>

#include "core/accel.h"
#include "core/frame.h"
#include "core/scene.h"

namespace photopic {

/// A hit, as shading needs it; of one path (T float) or 16.
template <typename T>
struct BasicSurfacePoint {
  Vec3<T> position;
  Vec3<T> geometric_normal;  ///< unit, on the triangle's front
  Vec3<T> shading_normal;    ///< unit, on the same side
  T error;                   ///< bound on the distance between position and the triangle's plane [m]

  /// Where a ray towards w starts: moved off the surface, by more than rounding may have moved it, to the
  /// side of w.
  Vec3<T> leave(Vec3<T> w) const {
    return position + geometric_normal * select(dot(geometric_normal, w) < 0.0f, -error, error);
  }
};
using SurfacePoint = BasicSurfacePoint<float>;
using SurfacePointLanes = BasicSurfacePoint<Lanes>;

inline SurfacePoint lane(const SurfacePointLanes& p, int i) {
  return {lane(p.position, i), lane(p.geometric_normal, i), lane(p.shading_normal, i), lane(p.error, i)};
}
inline void set_lane(SurfacePointLanes& p, int i, const SurfacePoint& point) {
  set_lane(p.position, i, point.position);
  set_lane(p.geometric_normal, i, point.geometric_normal);
  set_lane(p.shading_normal, i, point.shading_normal);
  p.error[i] = point.error;
}

/// Rounding of a point interpolated on a triangle and of a ray tested against it, relative to the
/// coordinates' size: a few units in the last place each for the weights, the sums and the edge functions
/// (Pharr et al. 2023, section 6.8).
inline constexpr float kPositionError = 16 * 0x1p-24f;

template <typename T>
T position_error(Vec3<T> a, Vec3<T> b, Vec3<T> c) {
  return kPositionError * max(max(max_abs(a), max_abs(b)), max_abs(c));
}

/// The same of an instance, whatever the point and the ray: rounding of the prototype's points and of their
/// way to the world, and of a ray's way to the prototype, magnified on the way back.
/// @param half_size of the prototype's box about its own zero
inline float instance_error(const Affine& to_world, Vec3d half_size) {
  const double reach = max_abs(to_world.x) * half_size.x + max_abs(to_world.y) * half_size.y +
                       max_abs(to_world.z) * half_size.z + max_abs(to_world.t);
  return kPositionError * static_cast<float>(rounding_gain(to_world) * reach);
}

/// The share by which points of a triangle are drawn towards its middle: by more than rounding may have moved
/// them, so that beside an edge none comes to lie behind the wall that shares it. @param edge the triangle's
/// longest [m]
template <typename T>
T shrink_to_middle(T error, T edge) {
  return min(2.0f * error / edge, T{} + 1.0f);
}

/// The point of a triangle a, a + ab, a + ac at barycentric coordinates u and v, its shading normal being the
/// triangle's own.
template <typename T>
PHOTOPIC_INLINE BasicSurfacePoint<T> point_on_triangle(Vec3<T> a, Vec3<T> ab, Vec3<T> ac, T error, T u, T v) {
  const T edge = max(max_abs(ab), max_abs(ac));  // scaled, so that tiny triangles do not underflow
  const Vec3<T> normal = normalize(cross(ab / edge, ac / edge));
  const T shrink = shrink_to_middle(error, edge), third = T{} + 1.0f / 3.0f;
  return {a + ab * (u + (third - u) * shrink) + ac * (v + (third - v) * shrink), normal, normal, error};
}

/// Turns a point's shading normal to an interpolated one, unless that is zero.
template <typename T>
PHOTOPIC_INLINE void bend_normal(BasicSurfacePoint<T>& point, Vec3<T> n) {
  const T squared = dot(n, n);
  const Vec3<T> unit = n / sqrt(squared);
  const Vec3<T> bent = select(dot(unit, point.geometric_normal) < 0.0f, -unit, unit);
  point.shading_normal = select(squared > 0.0f, bent, point.shading_normal);
}

SurfacePoint surface_point(const Geometry& geometry, const Hit& hit);

/// Whether a ray in a direction met the front.
bool meets_front(const Geometry& geometry, const Hit& hit, Vec3f direction);

/// The same of the hits in a packet's slots.
SurfacePointLanes surface_points(const Geometry& geometry, std::span<const Hit> hits, const Packet& packet);

/// The shading frame for a viewer in direction wo; of a two-sided BSDF it turns to the viewer's side. Where
/// interpolated normals turn away from a viewer who sees the triangle, the triangle's own normal shades.
template <typename T>
PHOTOPIC_INLINE BasicFrame<T> shading_frame(const BasicSurfacePoint<T>& point, Vec3<T> wo, bool two_sided) {
  const auto consistent = dot(point.shading_normal, wo) * dot(point.geometric_normal, wo) > 0.0f;
  const Vec3<T> n = select(consistent, point.shading_normal, point.geometric_normal);
  return BasicFrame<T>::about(two_sided ? select(dot(n, wo) < 0.0f, -n, n) : n);
}

}  // namespace photopic
