#include "spectral/color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "spectral/color_difference.h"

namespace photopic {
namespace {

struct Pair {
  Lab first, second;
  double delta_e;
};

// Sharma, Wu, Dalal 2005, table 1.
const Pair kSharma[] = {
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.49, -0.0010}, {50, -2.49, 0.0009}, 7.1792},
    {{50, 2.49, -0.0010}, {50, -2.49, 0.0010}, 7.1792},
    {{50, 2.49, -0.0010}, {50, -2.49, 0.0011}, 7.2195},
    {{50, 2.49, -0.0010}, {50, -2.49, 0.0012}, 7.2195},
    {{50, -0.0010, 2.49}, {50, 0.0009, -2.49}, 4.8045},
    {{50, -0.0010, 2.49}, {50, 0.0010, -2.49}, 4.8045},
    {{50, -0.0010, 2.49}, {50, 0.0011, -2.49}, 4.7461},
    {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
    {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

TEST(ColorDifference, PublishedPairs) {
  EXPECT_EQ(std::size(kSharma), 34u);
  for (const Pair& pair : kSharma) {
    EXPECT_NEAR(delta_e_2000(pair.first, pair.second), pair.delta_e, 1e-4) << "against " << pair.delta_e;
    EXPECT_NEAR(delta_e_2000(pair.second, pair.first), pair.delta_e, 1e-4)
        << "swapped, against " << pair.delta_e;
  }
}

TEST(ColorDifference, SymmetricAndZeroOnlyForEquals) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> l(0, 100), ab(-128, 128);
  for (int i = 0; i < 10000; ++i) {
    const Lab a{l(random), ab(random), ab(random)}, b{l(random), ab(random), ab(random)};
    EXPECT_NEAR(delta_e_2000(a, b), delta_e_2000(b, a), 1e-10);
    EXPECT_EQ(delta_e_2000(a, a), 0.0);
    EXPECT_GT(delta_e_2000(a, b), 0.0);
  }
}

// A grey has no hue: only lightness counts, by S_L.
TEST(ColorDifference, GreysByLightnessAlone) {
  EXPECT_NEAR(delta_e_2000({50, 0, 0}, {51, 0, 0}), 1.0 / (1.0 + 0.015 * 0.25 / std::sqrt(20.25)), 1e-12);
}

TEST(Color, MatricesInvertEachOther) {
  for (const Rgb c : {Rgb{1, 0, 0}, Rgb{0, 1, 0}, Rgb{0, 0, 1}, Rgb{0.2, -0.7, 13.0}}) {
    const Rgb back = xyz_to_linear_srgb(linear_srgb_to_xyz(c));
    EXPECT_NEAR(back.r, c.r, 1e-13);
    EXPECT_NEAR(back.g, c.g, 1e-13);
    EXPECT_NEAR(back.b, c.b, 1e-13);
  }
}

// IEC 61966-2-1 prints the matrix to four digits.
TEST(Color, MatrixAsPublished) {
  const Xyz r = linear_srgb_to_xyz({1, 0, 0}), g = linear_srgb_to_xyz({0, 1, 0}),
            b = linear_srgb_to_xyz({0, 0, 1});
  const double published[] = {0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505};
  const double ours[] = {r.x, g.x, b.x, r.y, g.y, b.y, r.z, g.z, b.z};
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(ours[i], published[i], 6e-5);
  const Xyz white = linear_srgb_to_xyz({1, 1, 1});
  EXPECT_NEAR(white.x, d65_white().x, 1e-14);
  EXPECT_NEAR(white.y, 1.0, 1e-14);
  EXPECT_NEAR(white.z, d65_white().z, 1e-14);
}

/// Lindbloom's matrix from D50 to D65 (ASTM E308 whites), published to seven places.
TEST(Color, BradfordFromD50ToD65) {
  const Xyz d50{0.96422, 1.0, 0.82521}, d65{0.95047, 1.0, 1.08883};
  const ChromaticAdaptation adaptation(d50, d65);
  const double published[] = {0.9555766, -0.0230393, 0.0631636,  -0.0282895, 1.0099416,
                              0.0210077, 0.0122982,  -0.0204830, 1.3299098};
  const Xyz x = adaptation({1, 0, 0}), y = adaptation({0, 1, 0}), z = adaptation({0, 0, 1});
  const double ours[] = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(ours[i], published[i], 1e-6) << i;
}

TEST(Color, AdaptationCarriesWhiteToWhiteAndKeepsItsLuminance) {
  const Xyz a{1.09850, 1.0, 0.35585};
  const Xyz white = ChromaticAdaptation(a * 3.0, d65_white())(a * 2.0);
  EXPECT_NEAR(white.x, 2.0 * d65_white().x, 1e-12);
  EXPECT_NEAR(white.y, 2.0, 1e-12);
  EXPECT_NEAR(white.z, 2.0 * d65_white().z, 1e-12);
  EXPECT_THROW(ChromaticAdaptation({0, 0, 0}, d65_white()), std::invalid_argument);
  EXPECT_THROW(ChromaticAdaptation({0.2, 1.0, 0.0}, {4.0, 1.0, 0.0}), std::invalid_argument);
}

TEST(Color, TransferFunctionIsOddAndInverts) {
  for (double v = -2.0; v <= 2.0; v += 0.001) {
    EXPECT_NEAR(srgb_decode(srgb_encode(v)), v, 1e-6);
    EXPECT_DOUBLE_EQ(srgb_encode(-v), -srgb_encode(v));
  }
  EXPECT_DOUBLE_EQ(srgb_encode(1.0), 1.0);
  EXPECT_NEAR(srgb_encode(0.18), 0.46135613, 1e-7);
}

TEST(Color, Lab) {
  const Xyz white = d65_white();
  const Lab w = xyz_to_lab(white, white), black = xyz_to_lab({}, white);
  EXPECT_NEAR(w.l, 100.0, 1e-12);
  EXPECT_NEAR(std::hypot(w.a, w.b), 0.0, 1e-12);
  EXPECT_NEAR(black.l, 0.0, 1e-12);
  // 18 % grey; and the straight part, L* = (29/3)³ Y, below zero too.
  EXPECT_NEAR(xyz_to_lab(white * 0.18, white).l, 116.0 * std::cbrt(0.18) - 16.0, 1e-12);
  EXPECT_NEAR(xyz_to_lab(white * -0.01, white).l, -0.01 * std::pow(29.0 / 3.0, 3), 1e-12);
}

}  // namespace
}  // namespace photopic
