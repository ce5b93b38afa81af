#include "spectral/piecewise_density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace photopic {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Random knots with jumps, dark cells and cells of very different widths.
PiecewiseLinearDensity random_density(std::mt19937_64& random, int knots) {
  std::uniform_real_distribution<double> uniform;
  std::vector<double> x{360.0}, value{uniform(random)};
  for (int i = 1; i < knots; ++i) {
    const double kind = uniform(random);
    x.push_back(kind < 0.2 ? x.back() : x.back() + std::pow(10.0, -4.0 + 5.0 * uniform(random)));
    const bool dark = value.back() == 0.0 ? uniform(random) < 0.5 : uniform(random) < 0.2;
    value.push_back(dark ? 0.0 : std::pow(10.0, 3.0 * uniform(random)));
  }
  return {x, value};
}

TEST(PiecewiseLinearDensity, RefusesWhatIsNoDensity) {
  using D = PiecewiseLinearDensity;
  EXPECT_THROW(D({0.0}, {1.0}), std::invalid_argument);
  EXPECT_THROW(D({0.0, 1.0}, {1.0}), std::invalid_argument);
  EXPECT_THROW(D({1.0, 0.0}, {1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(D({1.0, 1.0}, {1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(D({0.0, 1.0}, {0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(D({0.0, 1.0}, {-1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(D({0.0, 1.0}, {std::nan(""), 2.0}), std::invalid_argument);
  EXPECT_THROW(D({0.0, kInfinity}, {1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(D({0.0, 1.0, 1.0, 1.0, 2.0}, {0.0, 0.0, 1.0, 0.0, 0.0}), std::invalid_argument)
      << "mass at one place";
}

TEST(PiecewiseLinearDensity, TriangleInClosedForm) {
  const PiecewiseLinearDensity density({0.0, 1.0, 3.0}, {0.0, 5.0, 0.0});
  EXPECT_DOUBLE_EQ(density.density(1.0), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(density.cdf(0.5), 1.0 / 12.0);
  EXPECT_DOUBLE_EQ(density.cdf(1.0), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(density.inverse(1.0 / 12.0), 0.5);
  EXPECT_DOUBLE_EQ(density.inverse(1.0 - 1.0 / 6.0), 2.0);  // 1 − (3 − x)²/6
  EXPECT_EQ(density.density(-0.1), 0.0);
  EXPECT_EQ(density.density(3.1), 0.0);
  EXPECT_EQ(density.cdf(-1.0), 0.0);
  EXPECT_EQ(density.cdf(4.0), 1.0);
}

TEST(PiecewiseLinearDensity, CdfIsTheIntegralOfTheDensity) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const PiecewiseLinearDensity density = random_density(random, 40);
    const auto x = density.x();
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double width = x[i + 1] - x[i];
      if (width == 0.0) continue;
      // Two points integrate a linear function exactly.
      const double a = x[i] + 0.25 * width, b = x[i] + 0.75 * width;
      EXPECT_NEAR(density.cdf(x[i + 1]) - density.cdf(x[i]),
                  0.5 * width * (density.density(a) + density.density(b)), 1e-12);
    }
  }
}

TEST(PiecewiseLinearDensity, InverseInvertsAndAvoidsTheDark) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform;
  for (int trial = 0; trial < 50; ++trial) {
    const PiecewiseLinearDensity density = random_density(random, 60);
    std::vector<double> us{0.0, 1.0, 0.5, std::nextafter(1.0, 0.0), 5e-324};
    for (const double x : density.x()) us.push_back(density.cdf(x));
    for (int i = 0; i < 2000; ++i) us.push_back(uniform(random));
    for (const double u : us) {
      const auto [x, value] = density.draw(u);
      EXPECT_NEAR(density.cdf(x), u, 1e-12);
      EXPECT_EQ(x, density.inverse(u));
      const auto knots = density.x();
      const bool at_knot = std::binary_search(knots.begin(), knots.end(), x);
      if (at_knot) continue;
      EXPECT_GT(density.density(x), 0.0) << "inside a dark cell";
      EXPECT_NEAR(value, density.density(x), 1e-6 * density.density(x) + 1e-9);
    }
  }
}

TEST(PiecewiseLinearDensity, AJumpTakesTheValueToItsRight) {
  const PiecewiseLinearDensity density({0.0, 1.0, 1.0, 2.0}, {1.0, 1.0, 3.0, 3.0});
  EXPECT_DOUBLE_EQ(density.density(1.0), 0.75);
  EXPECT_DOUBLE_EQ(density.density(std::nextafter(1.0, 0.0)), 0.25);
  EXPECT_DOUBLE_EQ(density.density(2.0), 0.75);
}

// A line of 0.01 nm, 1e6 times brighter than the daylight beside it: every part keeps its exact share.
TEST(PiecewiseLinearDensity, NarrowBrightLineIsExact) {
  const double foot = 532.0, peak = 532.005, end = 532.01;
  const PiecewiseLinearDensity density({360.0, foot, peak, end, 830.0}, {1.0, 1.0, 1e6, 1.0, 1.0});
  const double left = foot - 360.0, line = (end - foot) * 0.5 * (1e6 + 1.0), right = 830.0 - end;
  const double total = left + line + right;
  EXPECT_NEAR(density.cdf(foot) / (left / total), 1.0, 1e-14);
  EXPECT_NEAR((density.cdf(end) - density.cdf(foot)) / (line / total), 1.0, 1e-13);
  EXPECT_NEAR((1.0 - density.cdf(end)) / (right / total), 1.0, 1e-12);
  EXPECT_NEAR(density.inverse((left + 0.5 * line) / total), peak, 1e-9);
}

TEST(PiecewiseLinearDensity, HundredThousandKnotsInACluster) {
  std::vector<double> x{360.0}, value{1.0};
  for (int i = 0; i < 100000; ++i) x.push_back(550.0 + i * 1e-7), value.push_back(i % 2 ? 1e-6 : 1e6);
  x.push_back(830.0), value.push_back(1.0);
  const PiecewiseLinearDensity density(x, value);
  for (std::size_t i = 1; i + 1 < x.size(); i += 997) {
    EXPECT_EQ(density.density(x[i]), density.value()[i]);
    EXPECT_NEAR(density.inverse(density.cdf(x[i])), x[i], 1e-9);
  }
}

TEST(PiecewiseLinearDensity, MadeAnewFromItsOwnValuesDrawsTheSameBits) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  const PiecewiseLinearDensity density = random_density(random, 100);
  const PiecewiseLinearDensity again({density.x().begin(), density.x().end()},
                                     {density.value().begin(), density.value().end()});
  for (int i = 0; i < 1000; ++i) {
    const double u = uniform(random);
    EXPECT_EQ(density.inverse(u), again.inverse(u));
  }
}

}  // namespace
}  // namespace photopic
