#include "spectral/observer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "spectral/spectrum.h"

namespace photopic {
namespace {

struct Tables {
  Observer::Table x, y, z;
};

Tables tables_of(const Observer& observer) {
  Tables t;
  for (int i = 0; i < Observer::kTableSize; ++i) {
    const Xyz h = observer(kLambdaMin + i);
    t.x[i] = h.x;
    t.y[i] = h.y;
    t.z[i] = h.z;
  }
  return t;
}

double trapezoid(const Observer::Table& table) {
  double sum = -0.5 * (table.front() + table.back());
  for (double v : table) sum += v;
  return sum;
}

/// The largest fourth difference: a wrong digit of size e at one place appears in it six times over.
double roughness(const Observer::Table& table) {
  double largest = 0.0;
  for (std::size_t i = 2; i + 2 < table.size(); ++i)
    largest = std::max(
        largest, std::abs(table[i - 2] - 4 * table[i - 1] + 6 * table[i] - 4 * table[i + 1] + table[i + 2]));
  return largest;
}

// A tenth above what the published tables themselves show (4.2e-4, 2.3e-4, 2.05e-3).
constexpr double kRoughX = 4.6e-4, kRoughY = 2.5e-4, kRoughZ = 2.25e-3;

TEST(Observer, IntegralsAreDerivedAndNearlyEqual) {
  const Observer& observer = Observer::cie1931();
  const Tables t = tables_of(observer);
  EXPECT_NEAR(observer.y_integral(), 106.8569, 5e-5);
  // The observer's primaries were chosen so that equal energy is white.
  EXPECT_NEAR(trapezoid(t.x) / observer.y_integral(), 1.0, 5e-4);
  EXPECT_NEAR(trapezoid(t.z) / observer.y_integral(), 1.0, 5e-4);
  EXPECT_NEAR(Observer::cie1964().y_integral(), 116.66, 0.01);
}

TEST(Observer, TablesAreSmooth) {
  const Tables t = tables_of(Observer::cie1931());
  EXPECT_LT(roughness(t.x), kRoughX);
  EXPECT_LT(roughness(t.y), kRoughY);
  EXPECT_LT(roughness(t.z), kRoughZ);
}

TEST(Observer, SmoothnessSeesOneWrongDigitAnywhere) {
  Tables t = tables_of(Observer::cie1931());
  const auto caught = [](Observer::Table& table, int i, double error, double bound) {
    table[i] += error;
    const bool seen = roughness(table) > bound;
    table[i] -= error;
    return seen;
  };
  for (int i = 2; i + 2 < Observer::kTableSize; ++i)
    for (double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(caught(t.x, i, sign * 2e-4, kRoughX)) << 360 + i;
      EXPECT_TRUE(caught(t.y, i, sign * 1e-4, kRoughY)) << 360 + i;
      EXPECT_TRUE(caught(t.z, i, sign * 1e-3, kRoughZ)) << 360 + i;
    }
  // Two digits exchanged in ȳ(547) = 0.9874182.
  t.y[547 - 360] = 0.9847182;
  EXPECT_GT(roughness(t.y), 10 * kRoughY);
  EXPECT_LT(std::abs(trapezoid(t.y) / Observer::cie1931().y_integral() - 1.0), 1e-4)
      << "the integral is blind to it";
}

TEST(Observer, ZeroOutsideAndLinearBetween) {
  const Observer& observer = Observer::cie1931();
  for (double lambda : {-1.0, 0.0, 359.999, 830.001, 1e300, std::nan("")}) {
    const Xyz h = observer(lambda);
    EXPECT_EQ(h.x, 0.0);
    EXPECT_EQ(h.y, 0.0);
    EXPECT_EQ(h.z, 0.0);
  }
  EXPECT_GT(observer(830.0).y, 0.0);
  EXPECT_DOUBLE_EQ(observer(555.25).y, 0.75 * observer(555).y + 0.25 * observer(556).y);
  EXPECT_DOUBLE_EQ(observer(555).y, 1.0);
}

// colord carries the observers at 5 nm, taken from elsewhere.
void compare_with_colord(const Observer& observer, const char* file) {
  std::ifstream stream(file);
  if (!stream) GTEST_SKIP() << file << " is not installed";
  std::string line;
  while (std::getline(stream, line) && !line.starts_with("BEGIN_DATA\r") && line != "BEGIN_DATA") continue;
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(std::getline(stream, line));
    std::istringstream row(line);
    double published = 0.0;
    int i = 0;
    for (; row >> published; ++i) {
      const Xyz h = observer(kLambdaMin + 5.0 * i);
      const double ours = k == 0 ? h.x : k == 1 ? h.y : h.z;
      EXPECT_NEAR(ours, published, 2e-5) << 360 + 5 * i;
    }
    EXPECT_EQ(i, 95);
  }
}

TEST(Observer, AgreesWithColord1931) {
  compare_with_colord(Observer::cie1931(), "/usr/share/colord/cmf/CIE1931-2deg-XYZ.cmf");
}

TEST(Observer, AgreesWithColord1964) {
  compare_with_colord(Observer::cie1964(), "/usr/share/colord/cmf/CIE1964-10deg-XYZ.cmf");
}

TEST(EmissionXyz, ConstantIsTheIntegrals) {
  const Tables t = tables_of(Observer::cie1931());
  const Xyz xyz = emission_xyz(tabulate_emission(ConstantSpectrum{1.0}), Observer::cie1931());
  EXPECT_NEAR(xyz.x, trapezoid(t.x) / trapezoid(t.y), 1e-13);
  EXPECT_NEAR(xyz.y, 1.0, 1e-13);
  EXPECT_NEAR(xyz.z, trapezoid(t.z) / trapezoid(t.y), 1e-13);
}

// Against a midpoint rule so fine that its own error is below the tolerance.
TEST(EmissionXyz, ExactForRandomTablesWithJumps) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(350, 840), height(0, 5);
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<double> lambda, value;
    for (int i = 0; i < 12; ++i) lambda.push_back(std::round(place(random) * 100) / 100);
    std::sort(lambda.begin(), lambda.end());
    lambda.erase(std::unique(lambda.begin(), lambda.end()), lambda.end());
    lambda.insert(lambda.begin() + 5, lambda[5]);
    for (std::size_t i = 0; i < lambda.size(); ++i) value.push_back(height(random));
    const TabulatedSpectrum table(lambda, value, Beyond::zero);
    Xyz sum;
    constexpr int kSteps = 100;  // a nm; knots fall between the midpoints
    for (int i = 0; i < 470 * kSteps; ++i) {
      const double x = kLambdaMin + (i + 0.5) / kSteps;
      sum += Observer::cie1931()(x) * (table(x) / kSteps);
    }
    const Xyz xyz = emission_xyz(table, Observer::cie1931());
    EXPECT_NEAR(xyz.x, sum.x / Observer::cie1931().y_integral(), 1e-7);
    EXPECT_NEAR(xyz.y, sum.y / Observer::cie1931().y_integral(), 1e-7);
    EXPECT_NEAR(xyz.z, sum.z / Observer::cie1931().y_integral(), 1e-7);
  }
}

// A line of power P narrower than the table's step gives P·h(centre).
TEST(EmissionXyz, NarrowLine) {
  for (double fwhm : {1e-6, 1e-3, 0.01}) {
    const Xyz xyz = emission_xyz(tabulate_emission(LineSpectrum{532.4, fwhm}), Observer::cie1931());
    const Xyz h = Observer::cie1931()(532.4);
    EXPECT_NEAR(xyz.y * Observer::cie1931().y_integral() / fwhm, h.y, 1e-6);
    EXPECT_NEAR(xyz.x * Observer::cie1931().y_integral() / fwhm, h.x, 1e-6);
  }
}

}  // namespace
}  // namespace photopic
