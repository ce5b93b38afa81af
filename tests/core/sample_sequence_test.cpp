#include "core/sample_sequence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/statistics.h"

namespace photopic {
namespace {

SampleStream sobol(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample) {
  return {Sequence::sobol, seed, pixel, sample};
}

/// Whether 2^m points put exactly one into each elementary interval of area 2^−m, of every shape.
bool is_net(const std::vector<Sample2d>& points, int m) {
  for (int across = 0; across <= m; ++across) {
    std::vector<int> count(points.size());
    for (const Sample2d& p : points) {
      const auto x = static_cast<std::size_t>(std::ldexp(p.x, across));
      const auto y = static_cast<std::size_t>(std::ldexp(p.y, m - across));
      if (++count[(y << across) + x] > 1) return false;
    }
  }
  return true;
}

TEST(SampleSequence, AlignedBlocksOfPowersOfTwoAreNets) {
  for (std::uint32_t pixel : {0u, 1u, 77777u})
    for (std::uint32_t dimension : {0u, 4u, 250u})
      for (int m = 0; m <= 11; ++m)
        for (std::uint32_t block : {0u, 5u}) {
          std::vector<Sample2d> points;
          for (std::uint32_t i = 0; i < (1u << m); ++i)
            points.push_back(sobol(3, pixel, (block << m) + i).get_2d(dimension));
          EXPECT_TRUE(is_net(points, m)) << "pixel " << pixel << " dimension " << dimension << " m " << m;
        }
}

TEST(SampleSequence, BitsAreStratified) {
  for (std::uint32_t pixel = 0; pixel < 8; ++pixel)
    for (int m = 1; m <= 14; ++m) {
      std::vector<bool> seen(1u << m);
      for (std::uint32_t i = 0; i < (1u << m); ++i) seen[sobol(9, pixel, i).bits(1) >> (32 - m)] = true;
      EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 1 << m);
    }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return 12.0 * sum / static_cast<double>(a.size());
}

/// Pixels and dimensions are scrambled apart: over many pairs the correlations scatter as those of
/// independent numbers do at most, ±1/√n each, and average to zero.
TEST(SampleSequence, PixelsAndDimensionsAreDecorrelated) {
  constexpr std::uint32_t kSamples = 256, kPairs = 400;
  for (Sequence sequence : {Sequence::sobol, Sequence::independent}) {
    test::RunningMean across_pixels, across_dimensions;
    for (std::uint32_t p = 0; p < kPairs; ++p) {
      std::vector<double> here, neighbour, other_dimension;
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        const SampleStream stream(sequence, 1, p, i);
        here.push_back(stream.get_1d(7));
        other_dimension.push_back(stream.get_2d(8).x);
        neighbour.push_back(SampleStream(sequence, 1, p + 1, i).get_1d(7));
      }
      across_pixels.add(correlation(here, neighbour));
      across_dimensions.add(correlation(here, other_dimension));
    }
    const double scatter = 1.0 / std::sqrt(double{kSamples});
    for (const test::RunningMean& c : {across_pixels, across_dimensions}) {
      const test::Estimate e = c.estimate();
      EXPECT_LT(std::abs(e.mean), 4.0 * 1.25 * scatter / std::sqrt(double{kPairs}));
      EXPECT_LT(e.error * std::sqrt(double{kPairs}), 1.4 * scatter);  // the scatter of single pairs
    }
  }
}

/// Every pixel's first sample, over the pixels: what a picture at one sample a pixel sees.
TEST(SampleSequence, FirstSamplesAreUniformOverPixels) {
  constexpr int kCells = 64, kPixels = 200000;
  std::vector<double> observed(kCells * kCells),
      expected(kCells * kCells, double{kPixels} / (kCells * kCells));
  for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    const Sample2d u = sobol(0, pixel, 0).get_2d(4);
    ++observed[static_cast<std::size_t>(u.y * kCells) * kCells + static_cast<std::size_t>(u.x * kCells)];
  }
  EXPECT_GT(test::chi_square_p_value(observed, expected), 1e-3);
}

TEST(SampleSequence, IndependentNumbersAreUniform) {
  constexpr int kCells = 64, kSamples = 200000;
  std::vector<double> pairs(kCells * kCells),
      expected_pairs(kCells * kCells, double{kSamples} / (kCells * kCells));
  std::vector<double> single(256), expected_single(256, kSamples / 256.0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const SampleStream stream(Sequence::independent, 5, 12, i);
    const Sample2d u = stream.get_2d(3);
    ++pairs[static_cast<std::size_t>(u.y * kCells) * kCells + static_cast<std::size_t>(u.x * kCells)];
    ++single[stream.bits(1) >> 24];
  }
  EXPECT_GT(test::chi_square_p_value(pairs, expected_pairs), 1e-3);
  EXPECT_GT(test::chi_square_p_value(single, expected_single), 1e-3);
}

TEST(SampleSequence, SeedsDiffer) {
  for (Sequence sequence : {Sequence::sobol, Sequence::independent})
    EXPECT_NE(SampleStream(sequence, 1, 0, 0).bits(1), SampleStream(sequence, 2, 0, 0).bits(1));
}

TEST(SampleSequence, NumbersStayBelowOne) {
  for (Sequence sequence : {Sequence::sobol, Sequence::independent})
    for (std::uint32_t i = 0; i < 100000; ++i) {
      const SampleStream stream(sequence, 0, 3, i);
      const Sample2d u = stream.get_2d(2);
      EXPECT_TRUE(stream.get_1d(0) < 1.0f && u.x < 1.0f && u.y < 1.0f && u.x >= 0.0f && u.y >= 0.0f);
    }
}

}  // namespace
}  // namespace photopic
