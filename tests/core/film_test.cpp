#include "core/film.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/statistics.h"

namespace photopic {
namespace {

TEST(Film, MeansAndVariances) {
  Film film(2, 1);
  for (double v : {1.0, 2.0, 3.0, 6.0}) film.add(0, {v, 2 * v, 0.0});
  EXPECT_DOUBLE_EQ(film.mean(0).x, 3.0);
  EXPECT_DOUBLE_EQ(film.mean(0).y, 6.0);
  // Sum of squared deviations 14, over n − 1 = 3, over n = 4.
  EXPECT_DOUBLE_EQ(film.variance_of_mean(0).x, 14.0 / 12.0);
  EXPECT_DOUBLE_EQ(film.variance_of_mean(0).y, 4.0 * 14.0 / 12.0);
  EXPECT_DOUBLE_EQ(film.variance_of_mean(0).z, 0.0);
  EXPECT_DOUBLE_EQ(film.mean(1).y, 0.0);
  EXPECT_DOUBLE_EQ(film.variance_of_mean(1).y, 0.0);
  EXPECT_DOUBLE_EQ(film.image_mean().x, 1.5);
  EXPECT_DOUBLE_EQ(film.image_variance_of_mean().x, 14.0 / 12.0 / 4.0);
}

TEST(Film, PartsKeepTheirPixels) {
  Film film(5, 4);
  for (std::size_t i = 0; i < 20; ++i) film.add(i, {double(i), 0.0, 0.0});
  const Film part = film.cropped({1, 2, 4, 4});
  ASSERT_EQ(part.width(), 3);
  ASSERT_EQ(part.height(), 2);
  const double expected[] = {11, 12, 13, 16, 17, 18};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(part.mean(i).x, expected[i]);
}

TEST(Film, WhiteBecomesWhite) {
  Film film(1, 1);
  film.add(0, d65_white());
  const Image image = film.to_linear_srgb();
  for (float channel : image.pixels) EXPECT_NEAR(channel, 1.0f, 1e-6f);
}

TEST(Film, AdaptsToTheWhiteOfSrgbAndKeepsXyzAsObserved) {
  const Xyz a{1.09850, 1.0, 0.35585};  // illuminant A, CIE 015:2018
  Film film(1, 1);
  film.add(0, a);
  for (float channel : film.to_linear_srgb({a, d65_white()}).pixels) EXPECT_NEAR(channel, 1.0f, 1e-6f);
  const Image xyz = film.to_xyz();
  EXPECT_EQ(xyz.space, ColorSpace::xyz);
  EXPECT_EQ(xyz.pixels, (std::vector<float>{1.09850f, 1.0f, 0.35585f}));
}

/// The tests' own statistics, against tables (Abramowitz & Stegun 1964, tables 26.1 and 26.8).
TEST(Statistics, KnownQuantiles) {
  EXPECT_NEAR(test::chi_square_tail(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(test::chi_square_tail(18.307038, 10), 0.05, 1e-6);
  EXPECT_NEAR(test::chi_square_tail(135.80672, 100), 0.01, 1e-6);
  EXPECT_NEAR(test::normal_threshold(0.05), 1.959964, 1e-5);
  EXPECT_NEAR(test::sidak_significance(0.05, 1), 0.05, 1e-12);
  EXPECT_NEAR(1 - std::pow(1 - test::sidak_significance(0.01, 36), 36), 0.01, 1e-12);
}

}  // namespace
}  // namespace photopic
