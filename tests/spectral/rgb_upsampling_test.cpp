#include "spectral/rgb_upsampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "spectral/illuminants.h"
#include "spectral/observer.h"
#include "spectral/spectrum.h"

namespace photopic {
namespace {

class RoundTrip : public testing::Test {
 protected:
  RoundTrip() : d65_(tabulate_emission(*cie_illuminant("D65"))) {
    white_y_ = emission_xyz(d65_, Observer::cie1931()).y;
  }

  /// The largest error of a channel, by integration at every nm, with the single-precision coefficients.
  double error(const Rgb& c) const {
    const SigmoidPolynomial s = upsample_reflectance(c);
    for (double lambda = kLambdaMin; lambda <= kLambdaMax; lambda += 1.0) {
      const double r = s(lambda);
      EXPECT_TRUE(r >= 0.0 && r <= 1.0) << "reflectance " << r << " of " << c.r << ' ' << c.g << ' ' << c.b;
    }
    const Xyz xyz = emission_xyz(tabulate_product(d65_, s), Observer::cie1931()) * (1.0 / white_y_);
    const Rgb back = xyz_to_linear_srgb(xyz);
    return std::max({std::abs(back.r - c.r), std::abs(back.g - c.g), std::abs(back.b - c.b)});
  }

  TabulatedSpectrum d65_;
  double white_y_;
};

TEST_F(RoundTrip, GridWithCorners) {
  constexpr int kSteps = 16;
  for (int r = 0; r <= kSteps; ++r)
    for (int g = 0; g <= kSteps; ++g)
      for (int b = 0; b <= kSteps; ++b) {
        const Rgb c{r / double{kSteps}, g / double{kSteps}, b / double{kSteps}};
        EXPECT_LE(error(c), 1e-3) << c.r << ' ' << c.g << ' ' << c.b;
      }
}

// Random colours, many of them within a hair of a face, an edge or a corner of the cube.
TEST_F(RoundTrip, RandomAndNearTheFaces) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto channel = [&] {
    const double kind = uniform(random), v = uniform(random);
    if (kind < 0.25) return std::pow(10.0, -6.0 * v);
    if (kind < 0.5) return 1.0 - std::pow(10.0, -6.0 * v);
    return v;
  };
  for (int i = 0; i < 4000; ++i) {
    const Rgb c{channel(), channel(), channel()};
    EXPECT_LE(error(c), 1e-3) << c.r << ' ' << c.g << ' ' << c.b;
  }
}

TEST(RgbUpsampling, GreysAreFlat) {
  for (double grey : {0.0, 1e-7, 0.18, 0.5, 0.999, 1.0}) {
    const SigmoidPolynomial s = upsample_reflectance({grey, grey, grey});
    for (double lambda : {360.0, 500.0, 830.0}) EXPECT_NEAR(s(lambda), grey, 1e-6);
    for (float lambda : {360.f, 500.f, 830.f}) EXPECT_NEAR(s(lambda), static_cast<float>(grey), 1e-6f);
  }
  EXPECT_EQ(upsample_reflectance({1, 1, 1})(550.f), 1.0f);
  EXPECT_EQ(upsample_reflectance({0, 0, 0})(550.f), 0.0f);
}

TEST(RgbUpsampling, OutOfRangeIsClamped) {
  const auto same = [](const Rgb& a, const Rgb& b) {
    const SigmoidPolynomial s = upsample_reflectance(a), t = upsample_reflectance(b);
    return s.c0 == t.c0 && s.c1 == t.c1 && s.c2 == t.c2;
  };
  EXPECT_TRUE(same({1.5, 0.3, -2.0}, {1.0, 0.3, 0.0}));
  EXPECT_TRUE(same({INFINITY, 0.3, -INFINITY}, {1.0, 0.3, 0.0}));
}

TEST(RgbUpsampling, InfiniteCoefficientsAreBlackOrWhite) {
  EXPECT_EQ((SigmoidPolynomial{0, 0, INFINITY}(500.0)), 1.0);
  EXPECT_EQ((SigmoidPolynomial{0, 0, -INFINITY}(500.0)), 0.0);
  EXPECT_EQ((SigmoidPolynomial{0, 0, 1e30f}(500.0f)), 1.0f) << "whose square is infinite";
  EXPECT_EQ((SigmoidPolynomial{0, 0, -1e30f}(500.0f)), 0.0f);
  EXPECT_TRUE(std::isnan(SigmoidPolynomial{0, 0, NAN}(500.0f)));
}

template <int N>
void expect_side_by_side_as_alone(const SigmoidPolynomial& reflectance) {
  SampledSpectrum<N> lambda;
  for (int j = 0; j < N; ++j) lambda.set(j, 360.0f + 470.0f * static_cast<float>(j) / N);
  const SampledSpectrum<N> values = reflectance(lambda);
  for (int j = 0; j < N; ++j)
    EXPECT_TRUE(std::abs(values[j] - reflectance(lambda[j])) < 1e-6f ||
                (std::isnan(values[j]) && std::isnan(reflectance(lambda[j]))))
        << lambda[j];
}

TEST(RgbUpsampling, SideBySideAsAlone) {
  for (const SigmoidPolynomial& reflectance :
       {upsample_reflectance({0.2, 0.5, 0.7}), upsample_reflectance({1, 0, 0}),
        upsample_reflectance({0, 0, 0}), SigmoidPolynomial{0, 0, 1e30f}, SigmoidPolynomial{0, 0, -INFINITY},
        SigmoidPolynomial{0, NAN, 0}}) {
    expect_side_by_side_as_alone<1>(reflectance);
    expect_side_by_side_as_alone<4>(reflectance);
    expect_side_by_side_as_alone<8>(reflectance);
    expect_side_by_side_as_alone<16>(reflectance);
  }
}

}  // namespace
}  // namespace photopic
