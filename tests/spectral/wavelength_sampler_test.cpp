#include "spectral/wavelength_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "spectral/illuminants.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

void expect_unbiased(const WavelengthSampler& sampler, const TabulatedSpectrum& emission,
                     const std::string& lamp) {
  const Xyz exact = emission_xyz(emission, Observer::cie1931());
  test::expect_same_xyz(test::mean_estimate(sampler, emission), exact, 1e-5,
                        std::string(sampler_name(sampler)) + ", " + lamp);
}

TEST(WavelengthSamplers, UnbiasedUnderEveryIlluminant) {
  std::uint64_t seed = 1;
  for (const std::string_view name : cie_illuminant_names()) {
    const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant(name));
    for (const WavelengthSampler& sampler : test::all_samplers(emission, 4, seed++))
      expect_unbiased(sampler, emission, std::string(name));
  }
}

TEST(WavelengthSamplers, UnbiasedWithAnyNumberOfWavelengths) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  for (const int count : {1, 2, 3, 8, 16})
    for (const WavelengthSampler& sampler : test::all_samplers(emission, count, 7))
      expect_unbiased(sampler, emission, std::to_string(count) + " wavelengths");
}

TEST(WavelengthSamplers, UnbiasedUnderHardLamps) {
  for (const auto& [name, emission] : test::hard_lamps())
    for (const WavelengthSampler& sampler : test::all_samplers(emission, 4, 11))
      expect_unbiased(sampler, emission, name);
}

TEST(WavelengthSamplers, DensitySumIsWhatWasDrawn) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL4"));
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  for (const WavelengthSampler& sampler : test::all_samplers(emission, 4, 5)) {
    for (int i = 0; i < 10000; ++i) {
      const auto drawn =
          sample_wavelengths<4>(sampler, i < 2 ? i * std::nextafter(1.0, 0.0) : uniform(random));
      for (int j = 0; j < 4; ++j) {
        ASSERT_GE(drawn.lambda[j], kLambdaMin);
        ASSERT_LE(drawn.lambda[j], kLambdaMax);
        ASSERT_GT(drawn.density_sum[j], 0.0);
        EXPECT_NEAR(drawn.density_sum[j] / density_sum(sampler, drawn.lambda[j]), 1.0, 1e-6)
            << sampler_name(sampler);
      }
    }
    EXPECT_EQ(density_sum(sampler, kLambdaMin - 1.0), 0.0);
    EXPECT_EQ(density_sum(sampler, kLambdaMax + 1.0), 0.0);
  }
}

TEST(WavelengthSamplers, DensitySumIntegratesToTheirNumber) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL2"));
  for (const WavelengthSampler& sampler : test::all_samplers(emission, 4, 3)) {
    double sum = 0.0;
    constexpr int kSteps = 470 * 400;
    const double step = (kLambdaMax - kLambdaMin) / kSteps;
    for (int i = 0; i < kSteps; ++i) sum += step * density_sum(sampler, kLambdaMin + (i + 0.5) * step);
    EXPECT_NEAR(sum, 4.0, 1e-3) << sampler_name(sampler);
  }
}

/// A normal deviate for chi-square with that many degrees of freedom: Wilson & Hilferty 1931.
double wilson_hilferty(double chi_square, double freedom) {
  const double variance = 2.0 / (9.0 * freedom);
  return (std::cbrt(chi_square / freedom) - (1.0 - variance)) / std::sqrt(variance);
}

// All N wavelengths of many paths, in equal cells of the range, against the integral of S.
TEST(WavelengthSamplers, DrawsFollowTheirDensities) {
  constexpr int kBins = 94, kDraws = 400000, kFine = 4000;
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform;
  for (const WavelengthSampler& sampler : test::all_samplers(emission, 4, 13)) {
    // One wavelength of each path alone, so that the counts are independent.
    std::vector<double> observed(kBins, 0.0), expected(kBins, 0.0);
    for (int i = 0; i < kDraws; ++i) {
      const auto drawn = sample_wavelengths<4>(sampler, uniform(random));
      const double lambda = drawn.lambda[static_cast<std::size_t>(4.0 * uniform(random))];
      observed[std::min(kBins - 1, static_cast<int>((lambda - kLambdaMin) / 5.0))] += 1.0;
    }
    for (int b = 0; b < kBins; ++b)
      for (int i = 0; i < kFine; ++i)
        expected[b] +=
            kDraws / 4.0 * 5.0 / kFine * density_sum(sampler, kLambdaMin + 5.0 * (b + (i + 0.5) / kFine));

    double chi_square = 0.0, pooled_observed = 0.0, pooled_expected = 0.0;
    int freedom = -1;
    const auto add = [&](double o, double e) { chi_square += (o - e) * (o - e) / e, ++freedom; };
    for (int b = 0; b < kBins; ++b) {
      if (expected[b] >= 10.0) {
        add(observed[b], expected[b]);
      } else {
        pooled_observed += observed[b], pooled_expected += expected[b];
      }
    }
    if (pooled_expected >= 5.0) add(pooled_observed, pooled_expected);
    EXPECT_LT(wilson_hilferty(chi_square, freedom), 4.0) << sampler_name(sampler);
  }
}

TEST(WavelengthSamplers, UniformIsEquallySpaced) {
  const auto drawn = sample_wavelengths<4>(UniformWavelengths{4}, 0.9);
  EXPECT_DOUBLE_EQ(drawn.lambda[0], 360.0 + 0.9 * 470.0);
  EXPECT_NEAR(drawn.lambda[1], 360.0 + 0.15 * 470.0, 1e-12);
  EXPECT_DOUBLE_EQ(drawn.density_sum[0], 4.0 / 470.0);
}

TEST(WavelengthSamplers, IlluminantStaysInItsStrata) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL7"));
  const PiecewiseLinearDensity base = base_density(emission);
  for (const double u : {0.0, 0.3, 0.999}) {
    const auto drawn = sample_wavelengths<4>(IlluminantWavelengths{4, base}, u);
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(base.cdf(drawn.lambda[j]), (j + u) / 4.0, 1e-12);
  }
}

// N steps, each in a stratum of its own, are the illuminant sampler.
TEST(WavelengthSamplers, SteppedStrataAreTheIlluminantSampler) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  WavelengthDistribution distribution{.base = base_density(emission), .components = {}, .stepped = true};
  for (int k = 0; k < 4; ++k) {
    distribution.components.push_back({std::vector<double>(4, 0.0)});
    distribution.components[k].nodes[k] = 2.5;
  }
  const WavelengthSampler stepped = OptimizedWavelengths(distribution),
                          illuminant = IlluminantWavelengths{4, distribution.base};
  for (int i = 0; i < 1000; ++i) {
    const auto a = sample_wavelengths<4>(stepped, i / 1000.0),
               b = sample_wavelengths<4>(illuminant, i / 1000.0);
    for (int j = 0; j < 4; ++j) {
      EXPECT_NEAR(a.lambda[j], b.lambda[j], 1e-8);
      EXPECT_NEAR(a.density_sum[j] / b.density_sum[j], 1.0, 1e-8);
    }
  }
  expect_unbiased(stepped, emission, "steps");
  distribution.components[0].backwards = true;  // mirrors one stratum's wavelength
  distribution.components[1].nodes = {0.5, 1.0, 2.0, 0.0};
  expect_unbiased(OptimizedWavelengths(distribution), emission, "unequal steps");
}

TEST(WavelengthSamplers, BackwardsRunsBackwards) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("D65"));
  WavelengthDistribution distribution = test::random_distribution(emission, 1, 20, 2);
  distribution.components[0].backwards = false;
  const WavelengthSampler forwards = OptimizedWavelengths(distribution);
  distribution.components[0].backwards = true;
  const WavelengthSampler backwards = OptimizedWavelengths(distribution);
  EXPECT_EQ(sample_wavelengths<1>(forwards, 0.25).lambda[0],
            sample_wavelengths<1>(backwards, 0.75).lambda[0]);
}

}  // namespace
}  // namespace photopic
