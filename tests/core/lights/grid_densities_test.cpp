#include "core/lights/grid_densities.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

using Grid = GridDensities::Grid<std::int32_t>;

/// Grids of several sizes in one array, with cells, rows and a whole grid of nothing.
TEST(GridDensities, SamplesFollowTheirDensities) {
  GridDensities densities;
  struct Case {
    std::int32_t width, height;
    std::vector<double> weights;
    Grid grid{};
  };
  std::vector<Case> cases = {{1, 1, {3.0}},
                             {3, 2, {1, 0, 2, 0, 0, 0}},
                             {5, 4, {0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 0, 1e-3, 0, 9, 0, 7, 0, 0, 0, 0}},
                             {2, 3, {0, 0, 0, 0, 0, 0}}};
  for (Case& c : cases)
    c.grid = {densities.add(c.weights, static_cast<std::size_t>(c.width)), c.width, c.height};
  for (const Case& c : cases) {
    const double total = std::accumulate(c.weights.begin(), c.weights.end(), 0.0);
    constexpr int kSide = 400;
    std::vector<double> observed(c.weights.size());
    for (int i = 0; i < kSide * kSide; ++i) {
      const Sample2d u{(static_cast<float>(i % kSide) + 0.5f) / kSide,
                       (static_cast<float>(i / kSide) + 0.5f) / kSide};
      const auto s = densities.sample<float>(c.grid, u);
      ASSERT_GE(s.part.x, 0.0f);
      ASSERT_LT(s.part.x, 1.0f);
      ASSERT_GT(s.probability, 0.0f);
      ASSERT_FLOAT_EQ(s.probability, densities.probability<float>(c.grid, s.x, s.y));
      observed[static_cast<std::size_t>(s.y * c.width + s.x)] += 1.0 / (kSide * kSide);
    }
    for (std::size_t i = 0; i < observed.size(); ++i) {
      const double expected = total > 0.0 ? c.weights[i] / total : 1.0 / static_cast<double>(observed.size());
      EXPECT_NEAR(observed[i], expected, 0.006);
      const auto x = static_cast<std::int32_t>(i) % c.width, y = static_cast<std::int32_t>(i) / c.width;
      EXPECT_NEAR(densities.probability<float>(c.grid, x, y), expected, 1e-6);
    }
  }
}

/// The numbers at the ends of [0, 1), and lanes with different grids.
TEST(GridDensities, EndsAndLanes) {
  GridDensities densities;
  std::vector<Grid> grids;
  for (std::int32_t n = 1; n <= kLanes; ++n) {
    std::vector<double> weights(static_cast<std::size_t>(2 * n));
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<double>((i * 5) % 3);
    grids.push_back({densities.add(weights, static_cast<std::size_t>(n)), n, 2});
  }
  for (const float u : {0.0f, 0.3f, 0.5f, 0x1.fffffep-1f}) {
    IntLanes first{}, width{};
    for (int i = 0; i < kLanes; ++i) {
      const Grid& g = grids[static_cast<std::size_t>(i)];
      first[i] = g.first, width[i] = g.width;
    }
    const GridDensities::Grid<IntLanes> all{first, width, IntLanes{} + 2};
    const auto s = densities.sample<Lanes>(all, {Lanes{} + u, Lanes{} + u});
    for (int i = 0; i < kLanes; ++i) {
      const auto one = densities.sample<float>(grids[static_cast<std::size_t>(i)], {u, u});
      EXPECT_GT(one.probability, 0.0f);
      EXPECT_EQ(s.x[i], one.x);
      EXPECT_EQ(s.y[i], one.y);
      EXPECT_FLOAT_EQ(s.probability[i], one.probability);
      EXPECT_FLOAT_EQ(s.part.x[i], one.part.x);
    }
  }
}

}  // namespace
}  // namespace photopic
