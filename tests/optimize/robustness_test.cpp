#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "optimize/quick.h"
#include "spectral/compensated_sum.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

using test::quick;

double trapezoid(std::span<const double> x, std::span<const double> y) {
  CompensatedSum sum;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) sum += (x[i + 1] - x[i]) * (0.5 * (y[i] + y[i + 1]));
  return sum.value();
}

/// The base and all densities on t have the integral 1 to rounding, and so have their products.
void expect_normalised(const WavelengthDistribution& found, const std::string& name) {
  EXPECT_NEAR(trapezoid(found.base.x(), found.base.value()), 1.0, 1e-12) << name;
  EXPECT_EQ(found.base.cdf(kLambdaMax), 1.0) << name;
  for (const PiecewiseLinearDensity& q : densities_on_t(found)) {
    EXPECT_NEAR(trapezoid(q.x(), q.value()), 1.0, 1e-12) << name;
    EXPECT_EQ(q.cdf(1.0), 1.0) << name;
  }
}

TEST(Robustness, SurvivesHardLamps) {
  for (const auto& [name, emission] : test::hard_lamps()) {
    const WavelengthDistribution found = quick(emission).distribution;
    EXPECT_TRUE(std::isfinite(found.value)) << name;
    for (const double baseline : {found.uniform_value, found.visible_value, found.illuminant_value}) {
      EXPECT_TRUE(std::isfinite(baseline)) << name;
      EXPECT_LE(found.value, baseline) << name;
    }
    const Xyz mean = test::mean_estimate(OptimizedWavelengths(found), emission);
    const Xyz exact = emission_xyz(emission, Observer::cie1931());
    EXPECT_NEAR(mean.x / exact.x, 1.0, 1e-5) << name;
    EXPECT_NEAR(mean.y / exact.y, 1.0, 1e-5) << name;
    if (exact.z > 0.0) {
      EXPECT_NEAR(mean.z / exact.z, 1.0, 1e-5) << name;
    }
    expect_normalised(found, name);
  }
}

TEST(Robustness, ScaleOfTheLampDoesNotMatter) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL1"));
  const double value = quick(emission).distribution.value;
  EXPECT_NEAR(quick(emission.scaled(0x1p-90)).distribution.value, value, 1e-6 * value);
}

TEST(Robustness, ManyRowsTakeNoLonger) {
  // (A regression would be a test that hangs: it once took half a minute.)
  const TabulatedSpectrum emission = test::dense_lamp(100000);
  const WavelengthDistribution found = quick(emission).distribution;
  EXPECT_LT(found.value, 0.5 * std::min(found.illuminant_value, found.visible_value));
  expect_normalised(found, "100,000 rows");
  const WavelengthSampler sampler = OptimizedWavelengths(found);
  // A midpoint rule is exact to the noise between its points: 1e-3 here.
  constexpr int kCount = 400000;
  double mean = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const auto drawn = sample_wavelengths<4>(sampler, (i + 0.5) / kCount);
    for (int j = 0; j < 4; ++j)
      mean +=
          Observer::cie1931()(drawn.lambda[j]).y * emission(drawn.lambda[j]) / drawn.density_sum[j] / kCount;
  }
  const double exact = emission_xyz(emission, Observer::cie1931()).y * Observer::cie1931().y_integral();
  EXPECT_NEAR(mean / exact, 1.0, 1e-3);
}

class NeverWorse : public testing::TestWithParam<int> {};

/// Than the samplers that need no optimisation, by the objective, under every lamp of the standard. (Eight
/// wavelengths take long: every sixteenth lamp.)
TEST_P(NeverWorse, ThanTheBaselines) {
  const std::vector<std::string_view> names = cie_illuminant_names();
  for (std::size_t i = 0; i < names.size(); i += GetParam() == 8 ? 16 : 1) {
    const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant(names[i]));
    const WavelengthDistribution found = quick(emission, GetParam()).distribution;
    EXPECT_LE(found.value, found.illuminant_value) << names[i];
    EXPECT_LE(found.value, found.visible_value) << names[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Wavelengths, NeverWorse, testing::Values(1, 2, 4, 8));

}  // namespace
}  // namespace photopic
