#pragma once

#include "core/accel.h"
#include "core/frame.h"
#include "core/scene.h"

namespace photopic {

/// A hit, as shading needs it.
struct SurfacePoint {
  Vec3f position;
  Vec3f geometric_normal;  ///< unit, on the triangle's front
  Vec3f shading_normal;    ///< unit, on the same side
  float error;             ///< bound on the distance between position and the triangle's plane [m]

  /// Where a ray towards w starts: moved off the surface, by more than rounding may have moved it, to the
  /// side of w.
  Vec3f leave(Vec3f w) const {
    return position + geometric_normal * (dot(geometric_normal, w) < 0.0f ? -error : error);
  }
};

/// Rounding of a point interpolated on a triangle and of a ray tested against it, relative to the
/// coordinates' size: a few units in the last place each for the weights, the sums and the edge functions
/// (Pharr et al. 2023, section 6.8).
inline constexpr float kPositionError = 16 * 0x1p-24f;

inline float position_error(Vec3f a, Vec3f b, Vec3f c) {
  return kPositionError * std::max({max_abs(a), max_abs(b), max_abs(c)});
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
inline float shrink_to_middle(float error, float edge) {
  return std::min(2.0f * error / edge, 1.0f);
}

inline SurfacePoint surface_point(const Geometry& geometry, const Hit& hit) {
  const auto& triangle = geometry.triangles[hit.triangle];
  Vec3f a = geometry.positions[triangle[0]];
  const Vec3f b = geometry.positions[triangle[1]];
  const Vec3f c = geometry.positions[triangle[2]];
  Vec3f ab = b - a, ac = c - a;
  SurfacePoint point;
  point.error = position_error(a, b, c);
  const Instance* instance = hit.instance == kNoInstance ? nullptr : &geometry.instances[hit.instance];
  if (instance) {
    const Affinef& m = instance->to_world;
    a = m.point(a), ab = m.vector(ab), ac = m.vector(ac);
    point.error = instance->error;
  }
  const float edge = std::max(max_abs(ab), max_abs(ac));  // scaled, so that tiny triangles do not underflow
  point.geometric_normal = normalize(cross(ab / edge, ac / edge));
  if (instance && instance->to_world.determinant() < 0.0f) point.geometric_normal = -point.geometric_normal;
  const float shrink = shrink_to_middle(point.error, edge);
  const float u = hit.u + (1.0f / 3.0f - hit.u) * shrink, v = hit.v + (1.0f / 3.0f - hit.v) * shrink;
  point.position = a + ab * u + ac * v;
  point.shading_normal = point.geometric_normal;
  if (!geometry.normals.empty()) {
    Vec3f n = geometry.normals[triangle[0]] * (1.0f - hit.u - hit.v) + geometry.normals[triangle[1]] * hit.u +
              geometry.normals[triangle[2]] * hit.v;
    if (instance) n = instance->to_world.normal(n);
    const float squared = dot(n, n);
    if (squared > 0.0f) point.shading_normal = n / std::sqrt(squared);
    if (dot(point.shading_normal, point.geometric_normal) < 0.0f)
      point.shading_normal = -point.shading_normal;
  }
  return point;
}

/// The shading frame for a viewer in direction wo; of a two-sided BSDF it turns to the viewer's side. Where
/// interpolated normals turn away from a viewer who sees the triangle, the triangle's own normal shades.
inline Frame shading_frame(const SurfacePoint& point, Vec3f wo, bool two_sided) {
  const bool consistent = dot(point.shading_normal, wo) * dot(point.geometric_normal, wo) > 0.0f;
  const Vec3f n = consistent ? point.shading_normal : point.geometric_normal;
  return Frame::about(two_sided && dot(n, wo) < 0.0f ? -n : n);
}

}  // namespace photopic
