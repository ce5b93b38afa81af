#include "optimize/objective.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "optimize/candidate.h"
#include "optimize/reflectance_set.h"
#include "optimize/sampler_value.h"
#include "spectral/color_difference.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

Targets targets_for(const char* lamp, Objective objective) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant(lamp));
  return {objective, White::d65, emission, {emission}, target_reflectances(12, 1)};
}

TEST(ReflectanceSet, StartsWithWhiteAndSpansTheGamut) {
  const std::vector<Spectrum> set = target_reflectances(200, 3);
  ASSERT_EQ(set.size(), 200u);
  for (const double nm : {360.0, 555.0, 830.0}) EXPECT_EQ(evaluate(set[0], nm), 1.0);
  int octants[8] = {};
  const TabulatedSpectrum d65 = tabulate_emission(*cie_illuminant("D65"));
  const double white = emission_xyz(d65, Observer::cie1931()).y;
  for (std::size_t i = 1; i < set.size(); ++i) {
    const Xyz xyz = emission_xyz(tabulate_product(d65, set[i]), Observer::cie1931()) * (1.0 / white);
    const Rgb rgb = xyz_to_linear_srgb(xyz);
    ++octants[4 * (srgb_encode(rgb.r) > 0.5) + 2 * (srgb_encode(rgb.g) > 0.5) + (srgb_encode(rgb.b) > 0.5)];
    for (const double c : {rgb.r, rgb.g, rgb.b}) EXPECT_TRUE(c > -0.01 && c < 1.01);
  }
  for (const int count : octants) EXPECT_NEAR(count, 199 / 8.0, 8.0);
}

TEST(ReflectanceSet, DependsOnTheSeedAlone) {
  const auto a = target_reflectances(20, 5), b = target_reflectances(30, 5), c = target_reflectances(20, 6);
  EXPECT_EQ(evaluate(a[19], 500.0), evaluate(b[19], 500.0));
  EXPECT_NE(evaluate(a[19], 500.0), evaluate(c[19], 500.0));
}

// Near c the metric is CIEDE2000 itself, whichever way the colour moves.
TEST(ColorMetric, IsTheSquareOfSmallDeltaE) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  const Xyz white = d65_white();
  for (int trial = 0; trial < 200; ++trial) {
    const Xyz c = linear_srgb_to_xyz(
        {0.05 + 0.9 * uniform(random), 0.05 + 0.9 * uniform(random), 0.05 + 0.9 * uniform(random)});
    const ColorMetric metric = color_metric(c, white);
    const double size = 1e-4 * c.y;
    const Xyz delta{size * (uniform(random) - 0.5), size * (uniform(random) - 0.5),
                    size * (uniform(random) - 0.5)};
    const Xyz u = measured(metric, delta);
    const double exact = delta_e_2000(xyz_to_lab(c, white), xyz_to_lab(c + delta, white));
    EXPECT_NEAR(std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z) / exact, 1.0, 0.02);
  }
}

// The basis holds all targets: their colours come back from the integrals of its functions.
TEST(TargetBasis, KeepsEveryTargetsColor) {
  const Targets targets = targets_for("FL11", Objective::asymptotic);
  const Emitter lamp = make_emitter(targets.mixed);
  const TargetBasis basis =
      target_basis(base_density(targets.mixed), std::span(&lamp, 1), targets.reflectances, d65_white());
  for (std::size_t m = 0; m < targets.reflectances.size(); ++m) {
    const Xyz color =
        emission_xyz(tabulate_product(lamp.emission, targets.reflectances[m]), Observer::cie1931()) *
        (Observer::cie1931().y_integral() * lamp.scale);
    const Xyz exact = measured(color_metric(color, d65_white()), color);
    double channel[3] = {};
    for (int row = 0; row < 3; ++row)
      for (int c = 0; c < kChannels; ++c)
        channel[row] += basis.coordinates[m][row][c] * basis.table.integral[c];
    EXPECT_NEAR(channel[0], exact.x, 0.1) << m;
    EXPECT_NEAR(channel[1], exact.y, 0.1) << m;
    EXPECT_NEAR(channel[2], exact.z, 0.1) << m;
  }
}

class Gradient : public testing::TestWithParam<Objective> {};

TEST_P(Gradient, IsThatOfCentralDifferences) {
  constexpr int kWavelengths = 4, kNodes = 17;
  const Targets targets = targets_for("FL3", GetParam());
  const auto loss = std::make_shared<const EstimateLoss>(targets, base_density(targets.mixed));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  for (const std::vector<bool>& backwards :
       {std::vector{false, false, false, false}, std::vector{true, false, true, true}}) {
    ObjectiveFunction objective(loss, backwards, kNodes, 128);
    std::vector<double> v(kWavelengths * kNodes), gradient(v.size());
    for (double& x : v) x = 2.0 * uniform(random) - 1.0;
    objective(v, gradient);
    double largest = 0.0;
    for (const double g : gradient) largest = std::max(largest, std::abs(g));
    // (A sample that meets a kink, a node of the table or CIEDE2000's jump of the mean hue, would spoil a
    // difference; with this seed none does.)
    for (std::size_t i = 0; i < v.size(); ++i) {
      constexpr double kStep = 1e-6;
      std::vector<double> above = v, below = v;
      above[i] += kStep, below[i] -= kStep;
      const double difference = (objective(above, {}) - objective(below, {})) / (2.0 * kStep);
      EXPECT_NEAR(gradient[i], difference, 1e-6 * largest) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Gradient, testing::Values(Objective::asymptotic, Objective::mean_delta_e));

// Two ways to the same number: tables in t against the spectra themselves.
TEST(Objective, AgreesWithItsJudge) {
  for (const Objective kind : {Objective::asymptotic, Objective::mean_delta_e}) {
    const Targets targets = targets_for("D65", kind);
    const PiecewiseLinearDensity base = base_density(targets.mixed, 0.02, 0.3);
    const auto loss = std::make_shared<const EstimateLoss>(targets, base);
    Random random(4);
    const Candidate candidate = random_candidate(4, 25, random);
    ObjectiveFunction objective(loss, candidate.backwards, 25, 2048);
    WavelengthDistribution distribution{.base = base, .components = {}};
    for (int k = 0; k < 4; ++k) {
      WavelengthDistribution::Component component{{}, candidate.backwards[k]};
      for (int b = 0; b < 25; ++b) component.nodes.push_back(std::exp(candidate.v[k * 25 + b]));
      distribution.components.push_back(component);
    }
    const double judged = sampler_value(OptimizedWavelengths(distribution), targets);
    EXPECT_NEAR(objective(candidate.v, {}) / judged, 1.0, 0.02);
  }
}

// Halving every cell changes nothing: what a coarse level found is where the next one starts.
TEST(Candidates, RefiningKeepsTheDensities) {
  const Targets targets = targets_for("FL11", Objective::asymptotic);
  const auto loss = std::make_shared<const EstimateLoss>(targets, base_density(targets.mixed));
  Random random(8);
  const Candidate coarse = random_candidate(4, 13, random), fine = resampled(coarse, 25);
  ObjectiveFunction on_coarse(loss, coarse.backwards, 13, 256), on_fine(loss, fine.backwards, 25, 256);
  EXPECT_NEAR(on_coarse(coarse.v, {}), on_fine(fine.v, {}), 1e-9);
}

// One uniform wavelength has a closed form: E = 470·h·I, so the variance is an integral.
TEST(SamplerValue, OneUniformWavelengthInClosedForm) {
  const TabulatedSpectrum equal = tabulate_emission(ConstantSpectrum{1.0});
  const Targets targets{Objective::asymptotic, White::d65, equal, {equal}, {ConstantSpectrum{1.0}}};
  const Observer& observer = Observer::cie1931();
  const double scale = 1.0 / observer.y_integral();
  const Xyz mean = emission_xyz(equal, observer);
  const ColorMetric metric = color_metric(mean, d65_white());
  double variance = 0.0;
  constexpr int kSteps = 47000;
  for (int i = 0; i < kSteps; ++i) {
    const Xyz e = observer(kLambdaMin + 470.0 * (i + 0.5) / kSteps) * (470.0 * scale);
    const Xyz u = measured(metric, e - mean);
    variance += (u.x * u.x + u.y * u.y + u.z * u.z) / kSteps;
  }
  EXPECT_NEAR(sampler_value(UniformWavelengths{1}, targets) / std::sqrt(variance), 1.0, 1e-3);
}

}  // namespace
}  // namespace photopic
