#include "core/quads.h"

#include <optional>

namespace photopic {
namespace {

constexpr std::size_t kMinTriangles = 500'000;
constexpr double kMaxQuads = 0.6;  // a triangle; 0.5 where all are paired

using Triangle = std::array<std::uint32_t, 3>;

Vec3f normal_of(const Geometry& g, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return cross(g.positions[b] - g.positions[a], g.positions[c] - g.positions[a]);
}

/// More would make large boxes, and where rounding confuses the two, light would leak around the bend.
bool is_flat(const Geometry& g, const Quad& q) {
  const Vec3f a = normal_of(g, q[0], q[1], q[3]), b = normal_of(g, q[2], q[3], q[1]);
  constexpr float kCosine = 0.5f;
  return dot(a, b) > kCosine * std::sqrt(dot(a, a)) * std::sqrt(dot(b, b));
}

std::optional<Quad> join(const Geometry& g, const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (a[(i + 1) % 3] != b[(j + 2) % 3] || a[(i + 2) % 3] != b[(j + 1) % 3]) continue;
      const Quad quad{a[i], a[(i + 1) % 3], b[j], a[(i + 2) % 3]};
      return is_flat(g, quad) ? std::optional(quad) : std::nullopt;
    }
  return {};
}

/// Calls pair(quad) or single(triangle) for the triangles of a shape, in order.
template <typename Pair, typename Single>
void for_each_quad(const Geometry& g, const Shape& shape, const Pair& pair, const Single& single) {
  const std::uint32_t end = shape.first_triangle + shape.triangle_count;
  for (std::uint32_t t = shape.first_triangle; t < end;) {
    const auto quad = t + 1 < end ? join(g, g.triangles[t], g.triangles[t + 1]) : std::nullopt;
    if (quad)
      pair(*quad), t += 2;
    else
      single(Triangle(g.triangles[t])), t += 1;
  }
}

std::size_t count_quads(const Geometry& g) {
  std::size_t count = 0;
  for (const Shape& shape : g.shapes)
    for_each_quad(
        g, shape, [&](const Quad&) { ++count; }, [&](const Triangle&) { ++count; });
  return count;
}

}  // namespace

bool is_worth_pairing(const Geometry& geometry) {
  const std::size_t triangles = geometry.triangles.size();
  return triangles >= kMinTriangles &&
         static_cast<double>(count_quads(geometry)) <= kMaxQuads * static_cast<double>(triangles);
}

Quads::Quads(Geometry& g) {
  quads.reserve(count_quads(g));
  std::vector<Triangle> singles;
  for (const Shape& shape : g.shapes) {
    first.push_back(static_cast<std::uint32_t>(quads.size()));
    singles.clear();
    std::uint32_t out = shape.first_triangle;  // never ahead of what is read
    const auto pair = [&](const Quad& q) {
      quads.push_back(q);
      g.triangles[out++] = {q[0], q[1], q[3]};
      g.triangles[out++] = {q[2], q[3], q[1]};
    };
    for_each_quad(g, shape, pair, [&](const Triangle& t) { singles.push_back(t); });
    ranges.push_back({shape.first_triangle, (out - shape.first_triangle) / 2});
    for (const Triangle& t : singles) {
      quads.push_back({t[0], t[1], t[2], t[2]});
      g.triangles[out++] = t;
    }
  }
  first.push_back(static_cast<std::uint32_t>(quads.size()));
}

}  // namespace photopic
