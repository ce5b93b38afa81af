#include "spectral/rgb_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "spectral/illuminants.h"
#include "spectral/observer.h"
#include "spectral/spectrum.h"

namespace photopic {
namespace {

/// L*a*b* of reflectances under D65, by sums every nm.
class UnderD65 {
 public:
  UnderD65() {
    const TabulatedSpectrum d65 = tabulate_emission(*cie_illuminant("D65"));
    const Observer& observer = Observer::cie1931();
    double y = 0.0;
    for (double lambda = kLambdaMin; lambda <= kLambdaMax; lambda += 1.0) {
      weights_.push_back(observer(lambda) * d65(lambda));
      y += weights_.back().y;
    }
    for (Xyz& w : weights_) w = w * (1.0 / y);
  }

  Lab lab(const SigmoidPolynomial& s) const {
    Xyz xyz;
    for (std::size_t i = 0; i < weights_.size(); ++i) xyz += weights_[i] * s(kLambdaMin + double(i));
    return xyz_to_lab(xyz, d65_white());
  }

 private:
  std::vector<Xyz> weights_;
};

double delta_e(const Lab& a, const Lab& b) {
  return std::hypot(a.l - b.l, a.a - b.a, a.b - b.b);
}

Rgb decoded(int r, int g, int b) {
  return {srgb_decode(r / 255.0), srgb_decode(g / 255.0), srgb_decode(b / 255.0)};
}

SigmoidPolynomial look_up(const Rgb& c) {
  return tabulated_reflectance(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b));
}

TEST(RgbTable, RoundTripOverTheCube) {
  const UnderD65 under_d65;
  double sum = 0.0, worst = 0.0;
  int count = 0;
  for (int r = 0; r < 256; r += 15)
    for (int g = 0; g < 256; g += 15)
      for (int b = 0; b < 256; b += 15) {
        const Rgb c = decoded(r, g, b);
        const double e = delta_e(under_d65.lab(look_up(c)), xyz_to_lab(linear_srgb_to_xyz(c), d65_white()));
        EXPECT_LT(e, 1.0) << r << ' ' << g << ' ' << b;
        worst = std::max(worst, e);
        sum += e;
        ++count;
      }
  RecordProperty("worst", std::to_string(worst));
  RecordProperty("mean", std::to_string(sum / count));
  EXPECT_LT(sum / count, 0.11);
}

/// Cells meet without a step: what is beside a face of the cube's parts, a node, or the greys is alike.
TEST(RgbTable, NeighboursAreAlike) {
  const UnderD65 under_d65;
  for (int r = 4; r < 255; r += 6)
    for (int g : {0, 1, r - 1, r, r + 1, 254})
      for (int b : {0, r, r + 1}) {
        const Lab here = under_d65.lab(look_up(decoded(r, g, b)));
        const Lab next = under_d65.lab(look_up(decoded(r + 1, g, b)));
        const double exact = delta_e(xyz_to_lab(linear_srgb_to_xyz(decoded(r, g, b)), d65_white()),
                                     xyz_to_lab(linear_srgb_to_xyz(decoded(r + 1, g, b)), d65_white()));
        EXPECT_LT(delta_e(here, next), 1.25 * exact + 0.4) << r << ' ' << g << ' ' << b;
      }
}

TEST(RgbTable, GreysAreFlat) {
  for (float grey : {0.0f, 1e-6f, 0.18f, 0.5f, 0.999f, 1.0f})
    for (float lambda : {360.0f, 555.0f, 830.0f})
      EXPECT_NEAR(tabulated_reflectance(grey, grey, grey)(lambda), grey, 1e-6f);
  EXPECT_EQ(tabulated_reflectance(1, 1, 1)(500.0f), 1.0f);
  EXPECT_EQ(tabulated_reflectance(0, 0, 0)(500.0f), 0.0f);
}

TEST(RgbTable, OutOfRangeIsClamped) {
  const auto same = [](const SigmoidPolynomial& s, const SigmoidPolynomial& t) {
    return s.c0 == t.c0 && s.c1 == t.c1 && s.c2 == t.c2;
  };
  EXPECT_TRUE(same(tabulated_reflectance(1.5f, 0.3f, -2.0f), tabulated_reflectance(1.0f, 0.3f, 0.0f)));
  EXPECT_TRUE(same(tabulated_reflectance(NAN, 0.3f, INFINITY), tabulated_reflectance(0.0f, 0.3f, 1.0f)));
}

}  // namespace
}  // namespace photopic
