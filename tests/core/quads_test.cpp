#include "core/quads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "core/accel.h"
#include "core/surface.h"

namespace photopic {
namespace {

/// A wavy square of cells² · 2 triangles over [0, 1]² in x and z, the halves of a cell one after the other.
Geometry wave(std::uint32_t cells) {
  Geometry g;
  for (std::uint32_t y = 0; y <= cells; ++y)
    for (std::uint32_t x = 0; x <= cells; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(cells),
                  v = static_cast<float>(y) / static_cast<float>(cells);
      g.positions.push_back({u, 0.05f * std::sin(20 * u) * std::cos(20 * v), v});
    }
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = y * (cells + 1) + x, b = a + cells + 1;
      g.triangles.push_back({a, b, a + 1});
      g.triangles.push_back({a + 1, b, b + 1});
    }
  g.shapes = {{0, static_cast<std::uint32_t>(g.triangles.size()), 0}};
  return g;
}

/// The triangles whatever their order and which corner comes first.
std::multiset<std::array<std::uint32_t, 3>> triangles_of(const Geometry& g) {
  std::multiset<std::array<std::uint32_t, 3>> set;
  for (auto t : g.triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    set.insert(t);
  }
  return set;
}

Vec3f point_of(const Geometry& g, std::uint32_t triangle, float u, float v) {
  const auto& [a, b, c] = g.triangles[triangle];
  return g.positions[a] * (1 - u - v) + g.positions[b] * u + g.positions[c] * v;
}

constexpr std::uint32_t kManyCells = 520;  // enough triangles to be paired

TEST(Quads, KeepTheTrianglesAndTheirWinding) {
  Geometry g = wave(9);
  g.triangles.erase(g.triangles.begin() + 30);  // its neighbour is left alone
  g.shapes = {{0, 7, 0}, {7, static_cast<std::uint32_t>(g.triangles.size()) - 7, 1}};
  const auto before = triangles_of(g);
  const Quads made(g);
  EXPECT_EQ(triangles_of(g), before);
  EXPECT_EQ(made.ranges[0].pairs, 3u);  // of 7 triangles
  EXPECT_EQ(made.ranges[1].first_triangle, 7u);
  EXPECT_GE(made.ranges[1].pairs, 72u);  // of 154, but for one or two in each row
  EXPECT_EQ(made.first, (std::vector<std::uint32_t>{0, 4, 4 + 154 - made.ranges[1].pairs}));
  EXPECT_EQ(made.quads.size(), made.first.back());
}

TEST(Quads, PointsAreFoundInTheTriangles) {
  Geometry g = wave(4);
  g.triangles.erase(g.triangles.begin() + 8);
  g.shapes[0].triangle_count = static_cast<std::uint32_t>(g.triangles.size());
  const Quads made(g);
  for (std::uint32_t i = 0; i < made.quads.size(); ++i) {
    const auto corner = [&](int k) { return g.positions[made.quads[i][static_cast<std::size_t>(k)]]; };
    const bool alone = made.quads[i][2] == made.quads[i][3];
    for (const auto& [u, v] : {std::pair{0.1f, 0.2f}, {0.6f, 0.1f}, {0.7f, 0.5f}, {0.5f, 0.9f}}) {
      if (alone && u + v > 1) continue;
      // As Embree's manual has it: across corners 0, 1, 3 or, beyond the diagonal, back from corner 2.
      const Vec3f expected = u + v <= 1 ? corner(0) * (1 - u - v) + corner(1) * u + corner(3) * v
                                        : corner(2) * (u + v - 1) + corner(3) * (1 - u) + corner(1) * (1 - v);
      const auto place = made.ranges[0].locate(i, u, v);
      EXPECT_LT(max_abs(point_of(g, place.triangle, place.u, place.v) - expected), 1e-6f) << i;
    }
  }
}

TEST(Quads, SharpEdgesAndOtherWindingsDoNotJoin) {
  const auto count = [](Vec3f apex, std::array<std::uint32_t, 3> second) {
    Geometry g;
    g.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, apex};
    g.triangles = {{0, 1, 2}, second};
    g.shapes = {{0, 2, 0}};
    return Quads(g).quads.size();
  };
  EXPECT_EQ(count({1, 0, 1}, {3, 2, 1}), 1u);
  EXPECT_EQ(count({1, 0.5f, 1}, {3, 2, 1}), 1u);
  EXPECT_EQ(count({1, 0, 1}, {3, 1, 2}), 2u);
  EXPECT_EQ(count({0.5f, 2, 0.5f}, {3, 2, 1}), 2u);      // upright on the shared edge
  EXPECT_EQ(count({0.2f, 0.01f, 0.2f}, {3, 2, 1}), 2u);  // folded back
}

TEST(Quads, AreForManyTrianglesThatStandInPairs) {
  EXPECT_FALSE(is_worth_pairing(wave(300)));
  Geometry g = wave(kManyCells);
  EXPECT_TRUE(is_worth_pairing(g));
  std::shuffle(g.triangles.begin(), g.triangles.end(), std::mt19937(7));
  EXPECT_FALSE(is_worth_pairing(g));
}

bool is_occluded(const Accel& accel, const Ray& ray, float t_max) {
  RayArray rays(1);
  rays.set(0, ray, t_max);
  Shadow shadow{};
  accel.occluded(rays, std::array{0u}, std::span(&shadow, 1));
  return shadow == Shadow::blocked;
}

/// Every ray from above meets the one triangle that lies there.
TEST(Quads, RaysFindTheirTriangles) {
  Geometry g = wave(kManyCells);
  const std::vector<Surface> surfaces{Surface(Material{})};
  const Quads quads(g);
  const Accel accel(g, surfaces, &quads);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.001f, 0.999f);
  for (int i = 0; i < 20000; ++i) {
    const Ray ray{{uniform(random), 1.0f, uniform(random)}, {0, -1, 0}};
    const Hit hit = accel.intersect(ray);
    ASSERT_LT(hit.triangle, g.triangles.size());
    EXPECT_TRUE(hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1 + 1e-6f);
    const Vec3f p = point_of(g, hit.triangle, hit.u, hit.v);
    EXPECT_LT(max_abs(p - (ray.origin + ray.direction * hit.t)), 1e-6f);
    EXPECT_TRUE(is_occluded(accel, ray, hit.t * 1.001f));
    EXPECT_FALSE(is_occluded(accel, ray, hit.t * 0.999f));
  }
}

/// A ray through a roof below its ridge crosses both of a pair's triangles.
TEST(Quads, BothTrianglesOfAPairAreCrossed) {
  Geometry g;
  g.positions = {{-1, 0, 0}, {0, 0.4f, -1}, {0, 0.4f, 1}, {1, 0, 0}};
  g.triangles = {{0, 2, 1}, {3, 1, 2}};
  g.shapes = {{.first_triangle = 0, .triangle_count = 2}};
  const std::vector<Surface> surfaces{Surface(Material{})};
  const Quads quads(g);
  ASSERT_EQ(quads.quads.size(), 1u);
  const std::vector<float> touching(g.triangles.size());
  const Accel accel(g, surfaces, &quads, touching);
  std::array<Hit, 4> hits;
  ASSERT_EQ(accel.crossings({{-2, 0.3f, 0}, {1, 0, 0}}, 4, hits), 2u);
  EXPECT_NE(hits[0].triangle, hits[1].triangle);
  EXPECT_NEAR(hits[0].t + hits[1].t, 4.0f, 1e-5f);
}

/// However many they are; where there is no room for all, as many as there is room for.
TEST(Accel, EveryCrossingIsFoundOnce) {
  constexpr std::uint32_t kSheets = 100;
  Geometry g;
  for (std::uint32_t i = 0; i < kSheets; ++i) {
    const float z = static_cast<float>(i);
    g.positions.insert(g.positions.end(), {{-1, -1, z}, {1, -1, z}, {0, 1, z}});
    g.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  g.shapes = {{.first_triangle = 0, .triangle_count = kSheets}};
  const std::vector<Surface> surfaces{Surface(Material{})};
  const std::vector<float> touching(g.triangles.size());
  const Accel accel(g, surfaces, nullptr, touching);
  const Ray ray{{0, 0, -1}, {0, 0, 1}};
  std::vector<Hit> hits(2 * kSheets);
  ASSERT_EQ(accel.crossings(ray, 200, hits), kSheets);
  std::set<std::uint32_t> met;
  for (const Hit& hit : std::span(hits).first(kSheets)) {
    met.insert(hit.triangle);
    EXPECT_NEAR(hit.t, static_cast<float>(hit.triangle) + 1.0f, 1e-4f);
  }
  EXPECT_EQ(met.size(), kSheets);
  EXPECT_EQ(accel.crossings(ray, 40.5f, hits), 40u);
  EXPECT_EQ(accel.crossings(ray, 200, std::span(hits).first(50)), 50u);
}

/// Where the vertices' alpha is below the cutoff, rays go through pairs of triangles as through one.
TEST(Quads, CoverageIsThatOfTheTriangleHit) {
  Geometry g = wave(kManyCells);
  for (const Vec3f& p : g.positions) g.colors.push_back({1, 1, 1, p.x + p.z > 1 ? 1.0f : 0.0f});
  Material material;
  material.has_vertex_colors = true;
  material.alpha_mode = AlphaMode::mask;
  const std::vector<Surface> surfaces{Surface(material)};
  const Quads quads(g);
  const Accel accel(g, surfaces, &quads);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(0.001f, 0.999f);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{{uniform(random), 1.0f, uniform(random)}, {0, -1, 0}};
    const float diagonal = ray.origin.x + ray.origin.z - 1;
    if (std::abs(diagonal) < 2.0f / kManyCells) continue;
    EXPECT_EQ(accel.intersect(ray).shape == 0u, diagonal > 0);
    EXPECT_EQ(is_occluded(accel, ray, 2.0f), diagonal > 0);
  }
}

}  // namespace
}  // namespace photopic
