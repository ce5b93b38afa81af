#include "core/lights/alias_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sample_sequence.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

/// Weights over fifteen decades: the table neither loses the weak nor runs out of range.
TEST(AliasTable, VeryUnequalWeights) {
  std::vector<double> weights;
  for (int i = 0; i < 100; ++i) weights.push_back(std::pow(10.0, 0.15 * i - 7.0));
  const AliasTable table(weights);
  constexpr int kSamples = 100000;
  std::vector<double> observed(100), expected;
  double total = 0.0;
  for (std::size_t i = 0; i < 100; ++i) total += table.probability(i);
  EXPECT_NEAR(total, 1.0, 1e-6);
  for (std::size_t i = 0; i < 100; ++i) expected.push_back(kSamples * double{table.probability(i)} / total);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    double u = SampleStream(Sequence::independent, 1, 0, i).get_1d_fine(0);
    ++observed[table.sample(u)];
  }
  EXPECT_GT(chi_square_p_value(observed, expected), 1e-3);
}

/// What is left of u after a choice is uniform again, whatever was chosen.
TEST(AliasTable, LeavesAUniformNumber) {
  const AliasTable table(std::vector<double>{0.1, 3.0, 0.0, 1.0, 0.5});
  constexpr int kSamples = 100000, kBins = 16;
  std::vector<double> observed(5 * kBins), expected;
  for (std::size_t i = 0; i < 5; ++i)
    for (int b = 0; b < kBins; ++b) expected.push_back(kSamples * double{table.probability(i)} / kBins);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    double u = (i + 0.5) / kSamples;
    const std::uint32_t chosen = table.sample(u);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++observed[chosen * kBins + static_cast<std::size_t>(u * kBins)];
  }
  EXPECT_GT(chi_square_p_value(observed, expected), 1e-3);
}

}  // namespace
}  // namespace photopic
