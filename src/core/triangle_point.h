#pragma once

#include "core/accel.h"
#include "core/scene.h"

namespace photopic {

/// A point of a triangle, as textures see it. Without geometry: a place where nothing varies.
struct TrianglePoint {
  const Geometry* geometry = nullptr;
  std::uint32_t triangle = 0;
  float u = 0, v = 0;  ///< barycentric coordinates of the second and third vertex

  TrianglePoint() = default;
  TrianglePoint(const Geometry& g, std::uint32_t t, float second, float third)
      : geometry(&g), triangle(t), u(second), v(third) {}
  TrianglePoint(const Geometry& g, const Hit& hit) : TrianglePoint(g, hit.triangle, hit.u, hit.v) {}

  /// TEXCOORD_set; zero where the scene has none.
  Vec2f uv(int set) const {
    if (!geometry || geometry->uvs[static_cast<std::size_t>(set)].empty()) return {};
    const auto& uvs = geometry->uvs[static_cast<std::size_t>(set)];
    const auto& [a, b, c] = geometry->triangles[triangle];
    const float w = 1.0f - u - v;
    return {uvs[a].x * w + uvs[b].x * u + uvs[c].x * v, uvs[a].y * w + uvs[b].y * u + uvs[c].y * v};
  }

  /// COLOR_0, linear RGBA; 1 where the scene has none.
  Vec4f color() const {
    if (!geometry || geometry->colors.empty()) return {1, 1, 1, 1};
    const auto& [ia, ib, ic] = geometry->triangles[triangle];
    const Vec4f a = geometry->colors[ia], b = geometry->colors[ib], c = geometry->colors[ic];
    const auto mix = [&](float x, float y, float z) { return x * (1.0f - u - v) + y * u + z * v; };
    return {mix(a.x, b.x, c.x), mix(a.y, b.y, c.y), mix(a.z, b.z, c.z), mix(a.w, b.w, c.w)};
  }

  Vec4f look_up(const Texture& texture) const { return texture(uv(texture.uv_set)); }
};

/// The point of a triangle that is nearest to a position in (or by rounding beside) its plane.
inline TrianglePoint triangle_point_at(const Geometry& geometry, std::uint32_t triangle, Vec3f position) {
  const auto& [a, b, c] = geometry.triangles[triangle];
  const Vec3f origin = geometry.positions[a];
  const Vec3f ab = geometry.positions[b] - origin, ac = geometry.positions[c] - origin,
              ap = position - origin;
  const Vec3f n = cross(ab, ac);
  const float area2 = dot(n, n);
  const float u = std::clamp(dot(cross(ap, ac), n) / area2, 0.0f, 1.0f);
  return {geometry, triangle, u, std::clamp(dot(cross(ab, ap), n) / area2, 0.0f, 1.0f - u)};
}

}  // namespace photopic
