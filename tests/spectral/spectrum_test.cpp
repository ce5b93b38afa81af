#include "spectral/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "spectral/illuminants.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expect_full_range(const TabulatedSpectrum& table) {
  ASSERT_GE(table.lambda().size(), 2u);
  EXPECT_EQ(table.lambda().front(), kLambdaMin);
  EXPECT_EQ(table.lambda().back(), kLambdaMax);
  EXPECT_GT(table.lambda()[1], kLambdaMin);
  EXPECT_LT(table.lambda()[table.lambda().size() - 2], kLambdaMax);
  EXPECT_EQ(table(kLambdaMin - 1e-9), 0.0);
  EXPECT_EQ(table(kLambdaMax + 1e-9), 0.0);
}

/// The definition, read from the knots one after another.
double by_linear_search(const TabulatedSpectrum& s, Beyond beyond, double x) {
  const auto lambda = s.lambda(), value = s.value();
  if (x < lambda.front()) return beyond == Beyond::zero ? 0.0 : value.front();
  if (x > lambda.back()) return beyond == Beyond::zero ? 0.0 : value.back();
  std::size_t i = lambda.size() - 1;
  while (lambda[i] > x) --i;
  if (i + 1 == lambda.size()) return value[i];
  const double f = (x - lambda[i]) / (lambda[i + 1] - lambda[i]);
  return value[i] * (1 - f) + value[i + 1] * f;
}

/// Knots at very different distances, some doubled.
TabulatedSpectrum random_table(std::mt19937& random, Beyond beyond) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> lambda, value;
  double x = 300 + 400 * uniform(random);
  const int count = 1 + static_cast<int>(60 * uniform(random));
  for (int i = 0; i < count; ++i) {
    const bool jump = uniform(random) < 0.2;
    for (int k = 0; k < (jump ? 2 : 1); ++k) {
      lambda.push_back(x);
      value.push_back(uniform(random));
    }
    x += std::pow(10.0, 8 * uniform(random) - 6.5);
  }
  return {lambda, value, beyond};
}

TEST(TabulatedSpectrum, AgreesWithLinearSearch) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 400; ++trial) {
    const Beyond beyond = trial % 2 ? Beyond::zero : Beyond::end_value;
    const auto table = random_table(random, beyond);
    const double first = table.lambda().front(), last = table.lambda().back();
    std::uniform_real_distribution<double> place(first - 1, last + 1);
    for (int i = 0; i < 100; ++i) {
      const double x = place(random);
      EXPECT_EQ(table(x), by_linear_search(table, beyond, x));
    }
    for (double knot : table.lambda())
      for (double x : {std::nextafter(knot, 0.0), knot, std::nextafter(knot, 1e9)})
        EXPECT_EQ(table(x), by_linear_search(table, beyond, x));
  }
}

TEST(TabulatedSpectrum, JumpTakesTheSecondKnot) {
  const TabulatedSpectrum table({400, 500, 500, 600}, {1, 2, 4, 8}, Beyond::zero);
  EXPECT_EQ(table(500), 4);
  EXPECT_EQ(table.limit_from_left(500), 2);
  EXPECT_EQ(table.limit_from_right(500), 4);
  EXPECT_EQ(table.limit_from_left(400), 0);
  EXPECT_EQ(table.limit_from_right(400), 1);
  EXPECT_EQ(table(600), 8);
  EXPECT_EQ(table.limit_from_left(600), 8);
  EXPECT_EQ(table.limit_from_right(600), 0);
  EXPECT_EQ(table.limit_from_left(450), 1.5);
  EXPECT_TRUE(std::isnan(table(kNan)));
}

TEST(TabulatedSpectrum, BeyondItsEnds) {
  const TabulatedSpectrum emission({400, 500}, {1, 2}, Beyond::zero), one({400}, {3}, Beyond::end_value);
  EXPECT_EQ(emission(399.999), 0);
  EXPECT_EQ(emission(500.001), 0);
  EXPECT_EQ(one(0), 3);
  EXPECT_EQ(one(400), 3);
  EXPECT_EQ(one(1e9), 3);
}

TEST(TabulatedSpectrum, RefusesWhatIsNoTable) {
  const auto make = [](std::vector<double> x, std::vector<double> v) {
    TabulatedSpectrum(x, v, Beyond::zero);
  };
  EXPECT_THROW(make({}, {}), std::invalid_argument);
  EXPECT_THROW(make({400, 500}, {1}), std::invalid_argument);
  EXPECT_THROW(make({500, 400}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(make({400, 400, 400}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(make({400, kNan}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(make({400, 500}, {1, kInfinity}), std::invalid_argument);
}

// Planck's law in its plain form, in single steps.
TEST(Blackbody, PlancksLaw) {
  const double h = 6.62607015e-34, c = 299792458.0, k = 1.380649e-23;
  const auto radiance = [&](double t, double nm) {
    const double lambda = nm * 1e-9;
    return 2 * h * c * c / std::pow(lambda, 5) / (std::exp(h * c / (lambda * k * t)) - 1);
  };
  for (double t : {1500.0, 2856.0, 6500.0, 20000.0})
    for (double nm = 360; nm <= 830; nm += 10)
      EXPECT_NEAR(evaluate(BlackbodySpectrum{t}, nm) / (radiance(t, nm) / radiance(t, 560)), 1.0, 1e-10);
}

// Wien's displacement: λ_max T = 2.897771955e6 nm K.
TEST(Blackbody, PeaksWhereWienSays) {
  for (double t : {4000.0, 5500.0, 7500.0}) {
    const double peak = 2.897771955e6 / t;
    const BlackbodySpectrum body{t};
    EXPECT_GT(evaluate(body, peak), evaluate(body, peak - 0.5));
    EXPECT_GT(evaluate(body, peak), evaluate(body, peak + 0.5));
  }
}

TEST(Blackbody, ColdAndHotStayFinite) {
  for (double t : {100.0, 300.0, 1e5, 1e7}) {
    EXPECT_EQ(evaluate(BlackbodySpectrum{t}, 560), 1.0);
    EXPECT_GT(luminance(tabulate_emission(BlackbodySpectrum{t})), 0.0);
  }
  // Very hot: the Rayleigh–Jeans law, λ⁻⁴.
  EXPECT_NEAR(evaluate(BlackbodySpectrum{1e9}, 400), std::pow(560.0 / 400, 4), 1e-4);
  EXPECT_THROW(tabulate_emission(BlackbodySpectrum{0.0}), std::invalid_argument);
  EXPECT_THROW(tabulate_emission(BlackbodySpectrum{kNan}), std::invalid_argument);
}

TEST(TabulateEmission, CutsAtTheRangeWithInterpolatedKnots) {
  const auto table = tabulate_emission(TabulatedSpectrum({300, 400, 900}, {0, 100, 600}, Beyond::zero));
  expect_full_range(table);
  ASSERT_EQ(table.lambda().size(), 3u);
  EXPECT_DOUBLE_EQ(table.value()[0], 60);
  EXPECT_DOUBLE_EQ(table.value()[2], 530);
}

TEST(TabulateEmission, JumpsToZeroWhereTheTableEnds) {
  const auto table = tabulate_emission(TabulatedSpectrum({400, 500}, {3, 5}, Beyond::zero));
  expect_full_range(table);
  EXPECT_EQ(table(399.999), 0);
  EXPECT_EQ(table(400), 3);
  EXPECT_NEAR(table(499.9999999), 5, 1e-8);
  EXPECT_EQ(table(500), 0);
  EXPECT_EQ(table.lambda().size(), 6u);
}

TEST(TabulateEmission, OutsideTheRangeIsAllZero) {
  for (const auto& [a, b] : {std::pair{100.0, 359.0}, {831.0, 2000.0}, {100.0, 360.0}, {830.0, 900.0}}) {
    const auto table = tabulate_emission(TabulatedSpectrum({a, b}, {7, 7}, Beyond::zero));
    expect_full_range(table);
    EXPECT_EQ(luminance(table), 0.0) << a;
  }
  EXPECT_EQ(luminance(tabulate_emission(LineSpectrum{1064, 1})), 0.0);
  EXPECT_EQ(luminance(tabulate_emission(TabulatedSpectrum({500}, {7}, Beyond::zero))), 0.0);
}

TEST(TabulateEmission, EndValuesGoOn) {
  const auto table = tabulate_emission(TabulatedSpectrum({500}, {7}, Beyond::end_value));
  expect_full_range(table);
  EXPECT_NEAR(luminance(table), 7.0, 1e-12);
}

TEST(TabulateEmission, NarrowLinesKeepTheirPower) {
  for (double fwhm : {1e-9, 1e-4, 0.01, 1.0}) {
    const auto table = tabulate_emission(LineSpectrum{555, fwhm});
    expect_full_range(table);
    double power = 0;  // a triangle of unit height
    for (std::size_t i = 0; i + 1 < table.lambda().size(); ++i)
      power += 0.5 * (table.value()[i] + table.value()[i + 1]) * (table.lambda()[i + 1] - table.lambda()[i]);
    EXPECT_NEAR(power / fwhm, 1.0, 1e-3);
  }
  // Off round numbers no foot may be left beside the line.
  EXPECT_EQ(tabulate_emission(LineSpectrum{532.1, 1e-7})(450), 0.0);
  EXPECT_EQ(tabulate_product(LineSpectrum{532.1, 1e-7}, ConstantSpectrum{1})(450), 0.0);
  EXPECT_THROW(tabulate_emission(LineSpectrum{555, 0.0}), std::invalid_argument);
  EXPECT_THROW(tabulate_emission(LineSpectrum{555, 1e-15}), std::invalid_argument);
  EXPECT_THROW(tabulate_emission(LineSpectrum{555, kNan}), std::invalid_argument);
}

TEST(TabulateEmission, HundredThousandSamplesAndAnyScale) {
  std::vector<double> lambda, value;
  for (int i = 0; i < 100000; ++i) {
    lambda.push_back(300 + i * 0.006);
    value.push_back(1 + std::sin(i * 0.001));
  }
  const TabulatedSpectrum table(lambda, value, Beyond::zero);
  const auto emission = tabulate_emission(table);
  expect_full_range(emission);
  for (double x = 360; x <= 830; x += 0.37) EXPECT_NEAR(emission(x), table(x), 1e-12);
  for (double scale : {1e-30, 1e30}) {
    const auto scaled = tabulate_emission(table.scaled(scale));
    EXPECT_NEAR(luminance(scaled) / scale / luminance(emission), 1.0, 1e-12);
    EXPECT_EQ(digest(scaled), digest(emission));
  }
}

TEST(TabulateEmission, RefusesNegativeAndNotFinite) {
  EXPECT_THROW(tabulate_emission(ConstantSpectrum{-1}), std::invalid_argument);
  EXPECT_THROW(tabulate_emission(ConstantSpectrum{kNan}), std::invalid_argument);
  EXPECT_THROW(tabulate_emission(ConstantSpectrum{kInfinity}), std::invalid_argument);
  EXPECT_THROW(tabulate_emission(TabulatedSpectrum({400, 500}, {1, -1}, Beyond::zero)),
               std::invalid_argument);
}

TEST(MixEmissions, IsTheWeightedSum) {
  std::mt19937 random(5);
  std::vector<TabulatedSpectrum> parts = {
      tabulate_emission(random_table(random, Beyond::zero)), tabulate_emission(*cie_illuminant("FL11")),
      tabulate_emission(LineSpectrum{532, 0.003}),
      tabulate_emission(TabulatedSpectrum({500, 600}, {1, 2}, Beyond::zero))};
  const std::vector<double> weights = {0.5, 2.0, 0.0, 3.0};
  const auto mix = mix_emissions(parts, weights);
  expect_full_range(mix);
  const auto sum = [&](double x) {
    double s = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) s += weights[i] * parts[i](x);
    return s;
  };
  for (double x = 360; x < 830; x += 0.0917) EXPECT_NEAR(mix(x), sum(x), 1e-9);
  for (double x : {500.0, 600.0, 532.0}) EXPECT_NEAR(mix(x), sum(x), 1e-9);
  EXPECT_THROW(mix_emissions(parts, std::vector<double>{1.0}), std::invalid_argument);
  EXPECT_THROW(mix_emissions(parts, std::vector<double>{1, 1, 1, -1}), std::invalid_argument);
  EXPECT_EQ(luminance(mix_emissions({}, {})), 0.0);
}

TEST(TabulateProduct, KeepsKnotsOfBoth) {
  const TabulatedSpectrum filter({450.5, 450.5, 600}, {0, 1, 0}, Beyond::end_value);
  const auto product = tabulate_product(*cie_illuminant("D65"), filter);
  expect_full_range(product);
  EXPECT_EQ(product(450.4), 0);
  EXPECT_DOUBLE_EQ(product(450.5), (*cie_illuminant("D65"))(450.5));
  EXPECT_EQ(product(700), 0);
  for (double x = 451; x < 600; x += 1) EXPECT_NEAR(product(x), (*cie_illuminant("D65"))(x)*filter(x), 1e-10);
}

TEST(Digest, TellsSpectraApartButNotScales) {
  const auto d65 = *cie_illuminant("D65");
  const std::string own = digest(d65);
  EXPECT_EQ(own.size(), 16u);
  for (double scale : {1e-30, 0.1, 1.0 / 3.0, 7.0, 683.002, 1e30}) EXPECT_EQ(digest(d65.scaled(scale)), own);
  EXPECT_NE(digest(*cie_illuminant("D50")), own);
  std::vector<double> lambda(d65.lambda().begin(), d65.lambda().end()),
      value(d65.value().begin(), d65.value().end());
  value[40] *= 1.00001;
  EXPECT_NE(digest({lambda, value, Beyond::zero}), own);
  value[40] /= 1.00001;
  lambda[40] += 0.001;
  EXPECT_NE(digest({lambda, value, Beyond::zero}), own);
  // Values at simple fractions of the peak stay the same under any scale.
  const TabulatedSpectrum thirds({400, 500, 600}, {66.6, 99.9, 33.3}, Beyond::zero);
  for (int i = 1; i < 1000; ++i) EXPECT_EQ(digest(thirds.scaled(0.001 * i)), digest(thirds));
  // A fixed value: files written on one machine are read on another.
  EXPECT_EQ(digest({{400, 500}, {1, 2}, Beyond::zero}), "f78f059cfde6c129");
  EXPECT_EQ(digest({{400, 500}, {0, 0}, Beyond::zero}), digest({{400, 500}, {0, 0}, Beyond::zero}));
}

}  // namespace
}  // namespace photopic
