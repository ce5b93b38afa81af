#include "core/sampling.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/bsdf/microfacet.h"
#include "core/frame.h"
#include "support/bsdf_checks.h"

namespace photopic {
namespace {

using test::SphereCells;

constexpr int kSamples = 100000;

Sample2d uniform_pair(int i) {
  return SampleStream(Sequence::independent, 11, 0, static_cast<std::uint32_t>(i)).get_2d(0);
}

/// Chi-square of directions against their density over the whole sphere.
template <typename SampleFunction, typename Pdf>
double sphere_p_value(Vec3f axis, const SampleFunction& sample, const Pdf& pdf) {
  const SphereCells cells(axis);
  std::vector<double> observed(cells.size() + 1), expected;
  double total = 0.0;
  for (const auto& v : cells.integrate([&](Vec3f w) { return test::LocalBsdf::Value{0.0, pdf(w)}; })) {
    expected.push_back(v.pdf * kSamples);
    total += v.pdf;
  }
  EXPECT_NEAR(total, 1.0, 1e-3);
  expected.push_back(0.0);
  for (int i = 0; i < kSamples; ++i) ++observed[cells.cell_of(sample(uniform_pair(i)))];
  return test::chi_square_p_value(observed, expected);
}

TEST(Sampling, SinCosTwoPi) {
  double worst = 0.0;
  for (int i = 0; i <= 1 << 20; ++i) {
    const float u = static_cast<float>(i) * 0x1p-20f;
    const auto sc = sin_cos_two_pi(u);
    const double angle = 2.0 * std::numbers::pi * double{u};
    worst = std::max({worst, std::abs(sc.sin - std::sin(angle)), std::abs(sc.cos - std::cos(angle))});
  }
  EXPECT_LT(worst, 4e-7);
}

TEST(Sampling, CosineHemisphere) {
  EXPECT_GT(sphere_p_value({0, 0, 1}, sample_cosine_hemisphere<float>,
                           [](Vec3f w) { return cosine_hemisphere_pdf(w.z); }),
            1e-3);
}

/// Equal areas in barycentric coordinates are equal areas on the triangle: count in a fine grid's cells.
TEST(Sampling, Triangle) {
  constexpr int kGrid = 16;
  std::vector<double> observed(kGrid * kGrid), expected(kGrid * kGrid);
  for (int y = 0; y < kGrid; ++y)
    for (int x = 0; x + y < kGrid; ++x)  // the hypotenuse halves the last cell of each row
      expected[static_cast<std::size_t>(y * kGrid + x)] =
          kSamples * (x + y < kGrid - 1 ? 2.0 : 1.0) / (kGrid * kGrid);
  for (int i = 0; i < kSamples; ++i) {
    const Sample2d b = sample_triangle(uniform_pair(i));
    ASSERT_TRUE(b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f + 1e-6f);
    ++observed[static_cast<std::size_t>(b.y * kGrid) * kGrid + static_cast<std::size_t>(b.x * kGrid)];
  }
  EXPECT_GT(test::chi_square_p_value(observed, expected), 1e-3);
}

TEST(Sampling, GgxVisibleNormals) {
  double smallest = 1.0;
  std::size_t tests = 0;
  for (float alpha : {0.0025f, 0.04f, 0.25f, 1.0f})
    for (double cos_theta : {1.0, 0.7, 0.3, 0.05}) {
      const Ggx ggx{alpha};
      const Vec3f w = test::direction(cos_theta);
      const double p = sphere_p_value(
          {0, 0, 1}, [&](Sample2d u) { return ggx.sample_visible(w, u); },
          [&](Vec3f m) { return ggx.visible_pdf(w, m); });
      RecordProperty("p", std::to_string(p));
      EXPECT_GT(p, test::sidak_significance(0.01, 16)) << "alpha " << alpha << " cos " << cos_theta;
      smallest = std::min(smallest, p);
      ++tests;
    }
  EXPECT_EQ(tests, 16u);
}

/// ∫ D(m) cos dm = 1: the microsurface projects onto the macrosurface (Walter et al. 2007, equation 4).
TEST(Sampling, GgxProjectsToUnitArea) {
  for (float alpha : {0.0025f, 0.04f, 0.25f, 1.0f}) {
    double total = 0.0;
    for (const auto& v : SphereCells({0, 0, 1}).integrate([&](Vec3f m) {
           return test::LocalBsdf::Value{0.0, Ggx{alpha}.d(m) * std::max(0.0f, m.z)};
         }))
      total += v.pdf;
    EXPECT_NEAR(total, 1.0, 1e-4) << alpha;
  }
}

TEST(Sampling, PowerHeuristicSumsToOne) {
  for (float a : {1e-30f, 1e-3f, 1.0f, 1e30f})
    for (float b : {1e-30f, 1e-3f, 1.0f, 1e30f})
      EXPECT_NEAR(power_heuristic(a, b) + power_heuristic(b, a), 1.0f, 1e-6f);
}

TEST(Frame, IsOrthonormalAndRightHandedEverywhere) {
  std::vector<Vec3f> normals{{0, 0, 1},
                             {0, 0, -1},
                             {0, 0, 1},
                             {1, 0, 0},
                             {0, -1, 0},
                             {1, 0, -0.0f},
                             normalize(Vec3f{1e-4f, -1e-4f, -1}),
                             normalize(Vec3f{1e-20f, 0, -1})};
  for (int i = 0; i < 20000; ++i) {
    const Sample2d u = uniform_pair(i);
    const float z = 1.0f - 2.0f * u.x, r = safe_sqrt(1.0f - z * z);
    const SinCos phi = sin_cos_two_pi(u.y);
    normals.push_back(normalize(Vec3f{r * phi.cos, r * phi.sin, z}));
  }
  for (const Vec3f n : normals) {
    const Frame f = Frame::about(n);
    const float worst =
        std::max({std::abs(dot(f.s, f.t)), std::abs(dot(f.s, f.n)), std::abs(dot(f.t, f.n)),
                  std::abs(length(f.s) - 1), std::abs(length(f.t) - 1), length(cross(f.s, f.t) - f.n)});
    EXPECT_LT(worst, 1e-6f) << n.x << ' ' << n.y << ' ' << n.z;
    const Vec3f w{0.36f, -0.48f, 0.8f};
    EXPECT_LT(length(f.to_local(f.to_world(w)) - w), 1e-6f);
  }
}

TEST(Sampling, AngleAbove) {
  for (int i = 0; i <= 2000; ++i)
    for (double radius : {1e-12, 1.0, 1e12}) {
      const double angle = std::numbers::pi * std::pow(i / 2000.0, 3.0);  // small ones too
      const auto y = static_cast<float>(radius * std::sin(angle));
      const auto x = static_cast<float>(radius * std::cos(angle));
      const double exact = std::atan2(double{y}, double{x});
      EXPECT_NEAR(angle_above(y, x), exact, 3e-7 * exact) << angle;
    }
  EXPECT_EQ(angle_above(0.0f, 0.0f), 0.0f);
}

}  // namespace
}  // namespace photopic
