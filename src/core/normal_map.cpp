#include "core/normal_map.h"

#include <optional>

#include "core/triangle_point.h"

namespace photopic {
namespace {

/// A tangent, not yet perpendicular to the normal, and the side that the bitangent n × t lies on. The
/// bitangent points up in the image, against v.
struct Tangent {
  Vec3f t;
  float sign;
};

const Affinef* instance_of(const Geometry& geometry, const Hit& hit) {
  return hit.instance == kNoInstance ? nullptr : &geometry.instances[hit.instance].to_world;
}

std::optional<Tangent> given_tangent(const Geometry& geometry, const Hit& hit) {
  if (geometry.tangents.empty()) return std::nullopt;
  const auto& [ia, ib, ic] = geometry.triangles[hit.triangle];
  const Vec4f a = geometry.tangents[ia], b = geometry.tangents[ib], c = geometry.tangents[ic];
  const float w = 1.0f - hit.u - hit.v;
  const Vec3f t = Vec3f{a.x, a.y, a.z} * w + Vec3f{b.x, b.y, b.z} * hit.u + Vec3f{c.x, c.y, c.z} * hit.v;
  if (a.w == 0.0f || t == Vec3f{}) return std::nullopt;
  const Affinef* map = instance_of(geometry, hit);
  if (!map) return Tangent{t, a.w};
  return Tangent{map->vector(t), map->determinant() < 0.0f ? -a.w : a.w};
}

/// ∂p/∂u of the texture's coordinates.
std::optional<Tangent> texture_tangent(const Geometry& geometry, const Hit& hit, Vec3f normal,
                                       const Texture& texture) {
  const auto& [ia, ib, ic] = geometry.triangles[hit.triangle];
  const auto& uvs = geometry.uvs[texture.uv_set];
  if (uvs.empty()) return std::nullopt;
  const Vec2f a = texture.transform(uvs[ia]), b = texture.transform(uvs[ib]), c = texture.transform(uvs[ic]);
  const Vec2f ab{b.x - a.x, b.y - a.y}, ac{c.x - a.x, c.y - a.y};
  const float determinant = ab.x * ac.y - ab.y * ac.x;
  if (determinant == 0.0f || !std::isfinite(determinant)) return std::nullopt;
  const Vec3f p = geometry.positions[ia];
  Vec3f edge1 = geometry.positions[ib] - p, edge2 = geometry.positions[ic] - p;
  if (const Affinef* map = instance_of(geometry, hit)) edge1 = map->vector(edge1), edge2 = map->vector(edge2);
  const float orientation = determinant < 0.0f ? -1.0f : 1.0f;
  const Vec3f t = (edge1 * ac.y - edge2 * ab.y) * orientation;  // times |determinant|
  const Vec3f v = (edge2 * ab.x - edge1 * ac.x) * orientation;
  return Tangent{t, dot(cross(normal, t), v) < 0.0f ? 1.0f : -1.0f};
}

}  // namespace

Vec3f mapped_normal(const Geometry& geometry, const Hit& hit, const SurfacePoint& point, Vec3f wo,
                    const Texture& texture, float scale) {
  const Vec3f n = point.shading_normal;
  auto tangent = given_tangent(geometry, hit);
  if (!tangent) tangent = texture_tangent(geometry, hit, n, texture);
  if (!tangent) return n;
  const Vec3f t = tangent->t - n * dot(n, tangent->t);
  const float size = length(t);
  if (!(size > 0.0f)) return n;

  const Vec4f texel = TrianglePoint(geometry, hit).look_up(texture);
  const float x = (2.0f * texel.x - 1.0f) * scale;
  const float y = (2.0f * texel.y - 1.0f) * scale;
  const Vec3f mapped =
      t * (x / size) + cross(n, t) * (y * tangent->sign / size) + n * (2.0f * texel.z - 1.0f);
  const float squared = dot(mapped, mapped), side = dot(point.geometric_normal, wo);
  if (!(squared > 0.0f) || dot(mapped, point.geometric_normal) <= 0.0f || dot(mapped, wo) * side <= 0.0f)
    return n;
  return mapped / std::sqrt(squared);
}

Frame grain_frame(const Geometry& geometry, const Hit& hit, const SurfacePoint& point, const Frame& frame) {
  auto tangent = given_tangent(geometry, hit);
  if (!tangent) tangent = texture_tangent(geometry, hit, point.shading_normal, Texture{});
  if (!tangent) return frame;
  const Vec3f t = tangent->t - frame.n * dot(frame.n, tangent->t);
  const float size = length(t);
  if (!(size > 0.0f)) return frame;
  // Seen from behind, the frame's normal is turned but the bitangent is not.
  const float side = dot(frame.n, point.shading_normal) < 0.0f ? -tangent->sign : tangent->sign;
  return {t / size, cross(frame.n, t) * (side / size), frame.n};
}

}  // namespace photopic
