#include "optimize/sampler_report.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimize/path_estimate.h"
#include "optimize/reflectance_set.h"
#include "optimize/sampler_value.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

TabulatedSpectrum cie(const char* name) {
  return tabulate_emission(*cie_illuminant(name));
}

TEST(PathEstimate, IsUnbiasedForReflectances) {
  const TabulatedSpectrum light = cie("FL11");
  for (const WavelengthSampler& sampler : test::all_samplers(light, 4, 5)) {
    PathEstimate path(sampler, light);
    for (const Spectrum& reflectance : test_reflectances(3)) {
      Xyz mean;
      constexpr int kCount = 200000;
      for (int i = 0; i < kCount; ++i) {
        path.draw((i + 0.5) / kCount);
        mean += path.seen(reflectance) * (1.0 / kCount);
      }
      const Xyz expected = path.expected(reflectance);
      EXPECT_NEAR(mean.x, expected.x, 1e-3) << sampler_name(sampler);
      EXPECT_NEAR(mean.y, expected.y, 1e-3) << sampler_name(sampler);
      EXPECT_NEAR(mean.z, expected.z, 1e-3) << sampler_name(sampler);
    }
    EXPECT_NEAR(path.expected(ConstantSpectrum{1.0}).y, 1.0, 1e-9);
  }
}

// One wavelength, uniform, equal-energy light: Var Y = |Λ| ∫ȳ² dλ / (∫ȳ dλ)² − 1.
TEST(SamplerReport, LuminanceDeviationInClosedForm) {
  const Observer& observer = Observer::cie1931();
  double square = 0.0;
  for (double nm = kLambdaMin + 0.005; nm < kLambdaMax; nm += 0.01)
    square += 0.01 * observer(nm).y * observer(nm).y;
  const double mean = observer.y_integral();
  const double variance = (kLambdaMax - kLambdaMin) * square / (mean * mean) - 1.0;
  const SamplerReport report =
      sampler_report(UniformWavelengths{1}, tabulate_emission(ConstantSpectrum{1.0}), White::d65);
  EXPECT_NEAR(report.luminance_deviation, std::sqrt(variance), 1e-3);
}

TEST(SamplerReport, OnePathAgreesWithTheObjective) {
  const TabulatedSpectrum light = cie("FL11");
  const Targets targets{.objective = Objective::mean_delta_e,
                        .white = White::d65,
                        .mixed = light,
                        .emitters = {light},
                        .reflectances = {}};
  for (const WavelengthSampler& sampler : test::all_samplers(light, 4, 5))
    EXPECT_NEAR(sampler_report(sampler, light, White::d65).one_path_delta_e, sampler_value(sampler, targets),
                1e-6);
}

TEST(SamplerReport, NoErrorWhereThereIsNoChoice) {
  // Under a line every path of the illuminant sampler sees the same colour, for one wavelength is as another;
  // only the weights, and so the luminance, vary within it.
  const TabulatedSpectrum line = tabulate_emission(LineSpectrum{550.0, 0.01});
  const SamplerReport report =
      sampler_report(IlluminantWavelengths{4, base_density(line, 0.0)}, line, White::illuminant);
  EXPECT_LT(report.luminance_deviation, 1e-3);
  EXPECT_LT(report.white_delta_e, 1e-2);
  EXPECT_LT(report.reflectances_delta_e, 1e-2);
}

TEST(SamplerReport, ErrorFallsWithWavelengthsAndDoesNotDependOnScale) {
  const TabulatedSpectrum light = cie("D65");
  const SamplerReport four = sampler_report(VisibleWavelengths{4}, light, White::d65);
  const SamplerReport sixteen = sampler_report(VisibleWavelengths{16}, light, White::d65);
  EXPECT_LT(sixteen.white_delta_e, four.white_delta_e);
  EXPECT_LT(sixteen.reflectances_delta_e, four.reflectances_delta_e);
  EXPECT_LT(sixteen.luminance_deviation, four.luminance_deviation);
  EXPECT_LT(four.white_delta_e, four.one_path_delta_e);
  const SamplerReport dim = sampler_report(VisibleWavelengths{4}, light.scaled(1e-30), White::d65);
  EXPECT_NEAR(dim.white_delta_e, four.white_delta_e, 1e-9);
}

TEST(TestReflectances, AreNoTargets) {
  const std::vector<Spectrum> targets = target_reflectances(400, 1), tests = test_reflectances(24);
  for (const Spectrum& test : tests)
    for (const Spectrum& target : targets) {
      double difference = 0.0;
      for (double nm = 400.0; nm <= 700.0; nm += 10.0)
        difference = std::max(difference, std::abs(evaluate(test, nm) - evaluate(target, nm)));
      EXPECT_GT(difference, 1e-3);
    }
}

}  // namespace
}  // namespace photopic
