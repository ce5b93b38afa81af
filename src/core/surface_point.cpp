#include "core/surface_point.h"

namespace photopic {
namespace {

/// The triangles that a packet hit.
class HitTriangles {
 public:
  HitTriangles(const Geometry& geometry, std::span<const Hit> hits, const Packet& packet) {
    for (int i = 0; i < kLanes; ++i)
      vertices_[static_cast<std::size_t>(i)] = geometry.triangles[hits[packet[i]].triangle].data();
  }

  /// What stands at vertex k of each, in the space they were modelled in. Reads one number too many behind a
  /// vector, for which the last has room.
  Vec3Lanes corners(const std::vector<Vec3f>& values, std::size_t k) const {
    const auto [x, y, z, rest] =
        gather_rows<4>([&](int i) { return &values[vertices_[static_cast<std::size_t>(i)][k]]; });
    return {x, y, z};
  }

 private:
  std::array<const std::uint32_t*, kLanes> vertices_;
};

Vec3f interpolated_normal(const Geometry& geometry, const Hit& hit) {
  const auto& [a, b, c] = geometry.triangles[hit.triangle];
  const Vec3f n = geometry.normals[a] * (1.0f - hit.u - hit.v) + geometry.normals[b] * hit.u +
                  geometry.normals[c] * hit.v;
  return hit.instance == kNoInstance ? n : geometry.instances[hit.instance].to_world.normal(n);
}

/// Of an instance, which mirrors its triangles' front when its determinant is negative.
SurfacePoint instance_point(const Geometry& geometry, const Hit& hit) {
  const Instance& instance = geometry.instances[hit.instance];
  const auto& [ia, ib, ic] = geometry.triangles[hit.triangle];
  const Vec3f a = geometry.positions[ia];
  const Affinef& m = instance.to_world;
  SurfacePoint point = point_on_triangle(m.point(a), m.vector(geometry.positions[ib] - a),
                                         m.vector(geometry.positions[ic] - a), instance.error, hit.u, hit.v);
  if (m.determinant() < 0.0f) point.geometric_normal = -point.geometric_normal;
  point.shading_normal = point.geometric_normal;
  if (!geometry.normals.empty()) bend_normal(point, interpolated_normal(geometry, hit));
  return point;
}

}  // namespace

SurfacePoint surface_point(const Geometry& geometry, const Hit& hit) {
  if (hit.instance != kNoInstance) return instance_point(geometry, hit);
  const auto& [ia, ib, ic] = geometry.triangles[hit.triangle];
  const Vec3f a = geometry.positions[ia], b = geometry.positions[ib], c = geometry.positions[ic];
  SurfacePoint point = point_on_triangle(a, b - a, c - a, position_error(a, b, c), hit.u, hit.v);
  if (!geometry.normals.empty()) bend_normal(point, interpolated_normal(geometry, hit));
  return point;
}

bool meets_front(const Geometry& geometry, const Hit& hit, Vec3f direction) {
  if (hit.instance != kNoInstance)
    return dot(instance_point(geometry, hit).geometric_normal, direction) < 0.0f;
  const auto& [ia, ib, ic] = geometry.triangles[hit.triangle];
  const Vec3f a = geometry.positions[ia], ab = geometry.positions[ib] - a, ac = geometry.positions[ic] - a;
  const float edge = std::max(max_abs(ab), max_abs(ac));  // scaled, so that tiny triangles do not underflow
  return dot(cross(ab / edge, ac / edge), direction) < 0.0f;
}

SurfacePointLanes surface_points(const Geometry& geometry, std::span<const Hit> hits, const Packet& packet) {
  static_assert(offsetof(Hit, v) == offsetof(Hit, u) + sizeof(float));
  const auto [u, v] = gather_rows<2>([&](int i) { return &hits[packet[i]].u; });
  const HitTriangles triangles(geometry, hits, packet);
  const auto corner = [&](const std::vector<Vec3f>& of, std::size_t k) { return triangles.corners(of, k); };
  const Vec3Lanes a = corner(geometry.positions, 0), b = corner(geometry.positions, 1),
                  c = corner(geometry.positions, 2);
  SurfacePointLanes points = point_on_triangle(a, b - a, c - a, position_error(a, b, c), u, v);
  if (!geometry.normals.empty())
    bend_normal(points, corner(geometry.normals, 0) * (1.0f - u - v) + corner(geometry.normals, 1) * u +
                            corner(geometry.normals, 2) * v);
  if (geometry.instances.empty()) return points;
  for (int i = 0; i < kLanes; ++i)
    if (hits[packet[i]].instance != kNoInstance)
      set_lane(points, i, instance_point(geometry, hits[packet[i]]));
  return points;
}

}  // namespace photopic
