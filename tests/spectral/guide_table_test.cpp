#include "spectral/guide_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace photopic {
namespace {

// Ends at equal places, in a cluster, and at the edges of the steps, whatever the steps' width.
TEST(GuideTable, FindsTheFirstCellThatEndsBeyond) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform;
  for (const double steps_per_unit : {0.3, 1.0, 64.0, 1000.0 / 3.0}) {
    std::vector<double> ends;
    for (int i = 0; i < 60; ++i) ends.push_back(std::round(uniform(random) * 16.0) / 8.0 - 1.0);
    for (int i = 0; i < 60; ++i) ends.push_back(0.3 + 1e-9 * uniform(random));
    std::sort(ends.begin(), ends.end());
    const GuideTable table(-1.0, ends, steps_per_unit);
    std::vector<double> at = ends;
    for (int i = 0; i < 2000; ++i) at.push_back(-1.0 + 2.0 * uniform(random));
    for (const double x : at) {
      const auto beyond = std::upper_bound(ends.begin(), ends.end() - 1, x) - ends.begin();
      ASSERT_EQ(table.find(x), beyond) << x;
    }
  }
}

}  // namespace
}  // namespace photopic
