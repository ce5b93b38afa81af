#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>

#include "optimize/quick.h"
#include "optimize/reflectance_set.h"
#include "optimize/sampler_value.h"
#include "optimize/target_table.h"
#include "spectral/color_difference.h"
#include "spectral/illuminants.h"
#include "spectral/lamp_set.h"
#include "spectral/observer.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

using test::optimize_for, test::quick;

/// Reflectances of another family than the targets: edges and bands with corners, as wide as those of paints.
std::vector<Spectrum> held_back_reflectances() {
  std::vector<Spectrum> set{ConstantSpectrum{0.2}};
  for (double nm = 450.0; nm < 680.0; nm += 30.0) {
    set.push_back(TabulatedSpectrum({nm - 50.0, nm + 50.0}, {0.1, 0.7}, Beyond::end_value));
    set.push_back(TabulatedSpectrum({nm - 50.0, nm + 50.0}, {0.6, 0.2}, Beyond::end_value));
    set.push_back(TabulatedSpectrum({nm - 80.0, nm, nm + 80.0}, {0.1, 0.5, 0.1}, Beyond::end_value));
  }
  return set;
}

/// The mean ΔE00 of the mean of 64 independent paths, by simulation.
double simulated_delta_e(const WavelengthSampler& sampler, const TabulatedSpectrum& emission) {
  constexpr int kPaths = 64, kTrials = 60;
  const Emitter emitter = make_emitter(emission);
  const std::vector<Spectrum> reflectances = held_back_reflectances();
  std::vector<Lab> exact;
  for (const Spectrum& reflectance : reflectances)
    exact.push_back(
        xyz_to_lab(emission_xyz(tabulate_product(emitter.emission, reflectance), Observer::cie1931()) *
                       (Observer::cie1931().y_integral() * emitter.scale),
                   d65_white()));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  double sum = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Xyz> mean(reflectances.size());
    for (int path = 0; path < kPaths; ++path) {
      const auto drawn = sample_wavelengths<4>(sampler, uniform(random));
      for (int j = 0; j < 4; ++j) {
        const double weight =
            emitter.scale * emitter.emission(drawn.lambda[j]) / (drawn.density_sum[j] * kPaths);
        const Xyz white = Observer::cie1931()(drawn.lambda[j]) * weight;
        for (std::size_t m = 0; m < mean.size(); ++m)
          mean[m] += white * evaluate(reflectances[m], drawn.lambda[j]);
      }
    }
    for (std::size_t m = 0; m < mean.size(); ++m)
      sum += delta_e_2000(exact[m], xyz_to_lab(mean[m], d65_white()));
  }
  return sum / (kTrials * static_cast<double>(reflectances.size()));
}

class Lamps : public testing::TestWithParam<const char*> {};

TEST_P(Lamps, BeatTheBaselinesByObjectiveAndBySimulation) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant(GetParam()));
  const OptimizeResult result = quick(emission);
  const WavelengthDistribution& found = result.distribution;
  EXPECT_LT(found.value, 0.5 * std::min({found.uniform_value, found.visible_value, found.illuminant_value}));
  EXPECT_LE(found.value, result.initial.value);
  EXPECT_FALSE(result.solver_failed) << result.solver_note;

  const double optimized = simulated_delta_e(OptimizedWavelengths(found), emission);
  EXPECT_LT(optimized, simulated_delta_e(UniformWavelengths{4}, emission) / 5.0);
  EXPECT_LT(optimized, simulated_delta_e(VisibleWavelengths{4}, emission) / 1.5);
  EXPECT_LT(optimized, simulated_delta_e(IlluminantWavelengths{4, base_density(emission)}, emission) / 1.5);
}

INSTANTIATE_TEST_SUITE_P(Cie, Lamps, testing::Values("A", "FL11", "HP1", "LED-B3"));

// A patch that reflects nothing has no error, and no say.
TEST(Solver, BlackTargetsChangeLittle) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  const Spectrum grey = ConstantSpectrum{0.3}, black = ConstantSpectrum{0.0};
  const auto with = [&](const std::vector<Spectrum>& reflectances) {
    OptimizeOptions options;
    options.effort = Effort::quick;
    options.reflectances = reflectances;
    return optimize_for(emission, options);
  };
  const OptimizeResult plain = with({grey}), result = with({grey, black});
  EXPECT_FALSE(result.solver_failed) << result.solver_note;
  EXPECT_NEAR(result.distribution.value * 50.0, plain.distribution.value * 49.0,
              plain.distribution.value * 2.5);
}

TEST(Solver, MeanDeltaEBeatsTheBaselinesToo) {
  const OptimizeResult result = quick(tabulate_emission(*cie_illuminant("FL11")), 4, Objective::mean_delta_e);
  const WavelengthDistribution& found = result.distribution;
  EXPECT_EQ(found.objective, "mean-delta-e");
  EXPECT_LT(found.value, 0.3 * std::min({found.uniform_value, found.visible_value, found.illuminant_value}));
}

TEST(Solver, AnswersAlikeOnAnyNumberOfThreads) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL2"));
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return quick(emission);
  };
  const OptimizeResult one = with_threads(1), many = with_threads(4);
  EXPECT_EQ(one.evaluations, many.evaluations);
  EXPECT_EQ(one.distribution.value, many.distribution.value);
  ASSERT_EQ(one.distribution.components.size(), many.distribution.components.size());
  for (std::size_t k = 0; k < one.distribution.components.size(); ++k) {
    EXPECT_EQ(one.distribution.components[k].nodes, many.distribution.components[k].nodes);
    EXPECT_EQ(one.distribution.components[k].backwards, many.distribution.components[k].backwards);
  }
}

TEST(Solver, ServesEveryNumberOfWavelengths) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("D65"));
  double previous = 1e9;
  for (const int count : {1, 2, 3, 4, 8, 16}) {
    const WavelengthDistribution found = quick(emission, count).distribution;
    ASSERT_EQ(static_cast<int>(found.components.size()), count);
    EXPECT_LT(found.value, previous) << "more wavelengths, less noise";
    EXPECT_LT(found.value, std::min({found.uniform_value, found.visible_value, found.illuminant_value}))
        << count;
    previous = found.value;
  }
}

TEST(Solver, SeveralLampsAreServedTogether) {
  const std::vector<TabulatedSpectrum> raw{tabulate_emission(*cie_illuminant("LED-B3")),
                                           tabulate_emission(*cie_illuminant("FL11"))};
  const std::vector<TabulatedSpectrum> lamps = lamp_set(raw, std::vector{1.0, 1.0});
  OptimizeOptions options;
  options.effort = Effort::quick;
  const WavelengthDistribution found = optimize_distribution(lamps, options).distribution;
  double optimized = 0.0, uniform = 0.0, visible = 0.0;
  for (const TabulatedSpectrum& lamp : lamps) {
    optimized += simulated_delta_e(OptimizedWavelengths(found), lamp);
    uniform += simulated_delta_e(UniformWavelengths{4}, lamp);
    visible += simulated_delta_e(VisibleWavelengths{4}, lamp);
  }
  EXPECT_LT(optimized, uniform / 3.0);
  EXPECT_LT(optimized, visible / 1.5);
}

/// Two lamps, one of smooth and one of line spectrum, of these relative powers.
std::vector<TabulatedSpectrum> a_and_fl11(double power_of_a) {
  const std::vector<TabulatedSpectrum> lamps{tabulate_emission(*cie_illuminant("A")),
                                             tabulate_emission(*cie_illuminant("FL11"))};
  return lamp_set(lamps, std::vector{power_of_a, 1.0});
}

double value_under(const char* lamp, const WavelengthDistribution& found) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant(lamp));
  return sampler_value(OptimizedWavelengths(found),
                       {Objective::asymptotic, White::d65, emission, {emission}, target_reflectances(24, 7)});
}

TEST(Solver, TheStrongerLampIsServedBetter) {
  OptimizeOptions options;
  options.effort = Effort::quick;
  const auto mostly_a = optimize_distribution(a_and_fl11(10.0), options).distribution,
             mostly_fl11 = optimize_distribution(a_and_fl11(0.1), options).distribution;
  EXPECT_LT(value_under("A", mostly_a), 0.8 * value_under("A", mostly_fl11));
  EXPECT_LT(value_under("FL11", mostly_fl11), 0.8 * value_under("FL11", mostly_a));
}

TEST(Solver, SeveralLampsAreUnbiasedOneByOne) {
  OptimizeOptions options;
  options.effort = Effort::quick;
  const std::vector<TabulatedSpectrum> lamps = a_and_fl11(0.3);
  const WavelengthDistribution found = optimize_distribution(lamps, options).distribution;
  for (const TabulatedSpectrum& lamp : lamps) {
    const Xyz mean = test::mean_estimate(OptimizedWavelengths(found), lamp);
    const Xyz exact = emission_xyz(lamp, Observer::cie1931());
    EXPECT_NEAR(mean.x / exact.x, 1.0, 1e-5);
    EXPECT_NEAR(mean.y / exact.y, 1.0, 1e-5);
    EXPECT_NEAR(mean.z / exact.z, 1.0, 1e-5);
  }
}

/// A filter's edge, which no smooth reflectance has.
Spectrum edge_at(double nm) {
  return TabulatedSpectrum({nm - 1.0, nm + 1.0}, {0.02, 0.9}, Beyond::end_value);
}

TEST(Solver, MeasuredReflectancesAreServedWhereGiven) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("LED-B3"));
  OptimizeOptions options;
  options.effort = Effort::quick;
  const WavelengthDistribution without = optimize_for(emission, options).distribution;
  options.target_count = 1;
  options.reflectances = {edge_at(500.0), edge_at(560.0), edge_at(610.0)};
  const WavelengthDistribution with = optimize_for(emission, options).distribution;
  const auto value = [&](const WavelengthDistribution& found) {
    return sampler_value(OptimizedWavelengths(found),
                         {Objective::asymptotic, White::d65, emission, {emission}, options.reflectances});
  };
  EXPECT_LT(value(with), 0.9 * value(without));
  EXPECT_EQ(with.targets.constructed, 1);
  EXPECT_EQ(with.targets.measured, 3);
  EXPECT_EQ(with.targets.measured_digest, reflectances_digest(options.reflectances));
  EXPECT_EQ(without.targets.measured, 0);
  EXPECT_EQ(without.targets.measured_digest, "");
}

TEST(ReflectancesDigest, TellsValuesApart) {
  const std::vector<Spectrum> half{ConstantSpectrum{0.5}}, table{edge_at(500.0)}, moved{edge_at(500.5)};
  EXPECT_EQ(reflectances_digest(half).size(), 16u);
  EXPECT_NE(reflectances_digest(half), reflectances_digest(std::vector<Spectrum>{ConstantSpectrum{0.25}}));
  EXPECT_NE(reflectances_digest(table), reflectances_digest(moved));
  EXPECT_EQ(reflectances_digest(table), reflectances_digest(std::vector<Spectrum>{edge_at(500.0)}));
  EXPECT_EQ(reflectances_digest({}), "");
}

TEST(Solver, NodesAreAsAsked) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL2"));
  OptimizeOptions options;
  options.effort = Effort::quick;
  double previous = 1e9;
  for (const int nodes : {3, 12, 48, 0}) {
    options.nodes = nodes;
    const WavelengthDistribution found = optimize_for(emission, options).distribution;
    if (nodes >= 48) {
      EXPECT_EQ(found.components[0].nodes.size(), static_cast<std::size_t>(nodes));
    }
    EXPECT_LE(found.value, std::min(found.visible_value, found.illuminant_value)) << nodes;
    EXPECT_LT(found.value, previous) << nodes;
    previous = found.value;
  }
}

TEST(Solver, StopsWhenItIsTold) {
  std::atomic<bool> stop = false;
  OptimizeOptions options;
  options.effort = Effort::thorough;
  options.stop = &stop;
  double last = 0.0;
  const auto report = [&](double fraction) {
    last = fraction;
    if (fraction > 0.001) stop = true;
  };
  EXPECT_THROW(optimize_for(tabulate_emission(*cie_illuminant("D65")), options, report), SearchStopped);
  EXPECT_LT(last, 0.1);
}

TEST(Solver, RefusesWhatCannotBeDone) {
  const TabulatedSpectrum dark({400.0, 700.0}, {0.0, 0.0}, Beyond::zero);
  EXPECT_THROW(quick(dark), std::invalid_argument);
  const TabulatedSpectrum light({400.0, 700.0}, {1.0, 1.0}, Beyond::zero);
  EXPECT_THROW(quick(light, 0), std::invalid_argument);
  EXPECT_THROW(quick(light, 17), std::invalid_argument);
  EXPECT_THROW(optimize_distribution(std::span<const TabulatedSpectrum>{}, {}), std::invalid_argument);
  OptimizeOptions options;
  for (const int nodes : {-1, 1, 2, 1026}) {
    options.nodes = nodes;
    EXPECT_THROW(optimize_for(light, options), std::invalid_argument) << nodes;
  }
  options.nodes = 0, options.target_count = 0;
  EXPECT_THROW(optimize_for(light, options), std::invalid_argument);
}

TEST(Solver, ReportsProgressUpToTheEnd) {
  OptimizeOptions options;
  options.effort = Effort::quick;
  double last = 0.0;
  bool rising = true;
  optimize_for(tabulate_emission(*cie_illuminant("E")), options, [&](double fraction) {
    rising = rising && fraction >= last;
    last = fraction;
  });
  EXPECT_TRUE(rising);
  EXPECT_NEAR(last, 1.0, 1e-9);
}

}  // namespace
}  // namespace photopic
