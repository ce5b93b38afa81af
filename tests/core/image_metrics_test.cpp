#include "core/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace photopic {
namespace {

Image grey(int width, int height, float value) {
  Image image(width, height);
  std::ranges::fill(image.pixels, value);
  return image;
}

TEST(ImageMetrics, EqualImagesDoNotDiffer) {
  const ImageDifference d = compare_images(grey(4, 3, -0.3f), grey(4, 3, -0.3f));
  EXPECT_EQ(d.max_delta_e, 0.0);
  EXPECT_EQ(d.mse, 0.0);
  EXPECT_EQ(d.relmse, 0.0);
  EXPECT_EQ(d.non_finite, 0u);
}

/// Greys differ in lightness alone: L* = 100 for Y = 1; Y = 0.125 has L* = 116·0.5 − 16 = 42. CIEDE2000 is
/// then ΔL'/S_L with S_L = 1 + 0.015 (L̄ − 50)² / sqrt(20 + (L̄ − 50)²), L̄ = 71.
TEST(ImageMetrics, GreysByHand) {
  const ImageDifference d = compare_images(grey(2, 2, 1.0f), grey(2, 2, 0.125f));
  const double expected = 58.0 / (1.0 + 0.015 * 441.0 / std::sqrt(461.0));
  EXPECT_NEAR(d.mean_delta_e, expected, 1e-6);
  EXPECT_NEAR(d.median_delta_e, expected, 1e-6);
  EXPECT_NEAR(d.mse, 0.875 * 0.875, 1e-12);
  EXPECT_NEAR(d.relmse, 0.875 * 0.875 / 1.01, 1e-12);
}

TEST(ImageMetrics, TheMapHasEveryPixel) {
  Image image = grey(2, 2, 1.0f);
  image.at(1, 0)[1] = 0.5f;
  image.at(0, 1)[2] = std::numeric_limits<float>::infinity();
  const std::vector<double> map = delta_e_map(grey(2, 2, 1.0f), image);
  ASSERT_EQ(map.size(), 4u);
  EXPECT_EQ(map[0], 0.0);
  EXPECT_EQ(map[1], compare_images(grey(2, 2, 1.0f), image).max_delta_e);
  EXPECT_TRUE(std::isnan(map[2]));
}

TEST(ImageMetrics, RelativeErrorIsOfTheReference) {
  const ImageDifference forth = compare_images(grey(1, 1, 0.5f), grey(1, 1, 1.0f));
  EXPECT_NEAR(forth.relmse, 0.25 / 0.26, 1e-12);
}

/// 21 pixels of which pixel k is k steps brighter: the order statistics are known by their rank.
TEST(ImageMetrics, PercentilesByRank) {
  const Image reference = grey(21, 1, 0.2f);
  Image image = reference;
  for (int k = 0; k <= 20; ++k) {
    for (int c = 0; c < 3; ++c) image.at(20 - k, 0)[c] += 0.01f * static_cast<float>(k);
  }
  const auto delta_e = [](int k) {
    return compare_images(grey(1, 1, 0.2f), grey(1, 1, 0.2f + 0.01f * static_cast<float>(k))).mean_delta_e;
  };
  const ImageDifference d = compare_images(reference, image);
  EXPECT_NEAR(d.median_delta_e, delta_e(10), 1e-4);
  EXPECT_NEAR(d.p95_delta_e, delta_e(19), 1e-4);
  EXPECT_NEAR(d.max_delta_e, delta_e(20), 1e-4);
}

TEST(ImageMetrics, ValuesOutsideTheDisplayCount) {
  EXPECT_GT(compare_images(grey(1, 1, 1.0f), grey(1, 1, 2.0f)).mean_delta_e, 1.0);
  EXPECT_GT(compare_images(grey(1, 1, 0.0f), grey(1, 1, -0.1f)).mean_delta_e, 1.0);
}

TEST(ImageMetrics, ANewWhiteChangesTheFigure) {
  Image image = grey(1, 1, 0.5f);
  image.at(0, 0)[0] = 0.6f;
  const double d65 = compare_images(grey(1, 1, 0.5f), image).mean_delta_e;
  const double a = compare_images(grey(1, 1, 0.5f), image, {1.0985, 1.0, 0.3558}).mean_delta_e;
  EXPECT_GT(std::abs(a - d65), 0.1);
}

TEST(ImageMetrics, NonFinitePixelsAreCountedNotAveraged) {
  Image image = grey(2, 2, 0.5f);
  image.at(0, 0)[1] = std::numeric_limits<float>::quiet_NaN();
  image.at(1, 1)[0] = std::numeric_limits<float>::infinity();
  const ImageDifference d = compare_images(grey(2, 2, 0.5f), image);
  EXPECT_EQ(d.non_finite, 2u);
  EXPECT_EQ(d.mean_delta_e, 0.0);
  EXPECT_TRUE(std::isnan(compare_images(grey(1, 1, std::nanf("")), grey(1, 1, 0.5f)).mean_delta_e));
}

TEST(ImageMetrics, SizesMustAgree) {
  EXPECT_THROW(compare_images(grey(2, 3, 0), grey(3, 2, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace photopic
