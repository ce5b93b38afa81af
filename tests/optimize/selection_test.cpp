#include "optimize/selection.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "optimize/reflectance_set.h"
#include "spectral/illuminants.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

Targets targets_for(const TabulatedSpectrum& emission) {
  return {Objective::asymptotic, White::d65, emission, {emission}, target_reflectances(12, 1)};
}

/// A descent that does not move and says that it failed.
Descent give_up(const Differentiable& function, std::vector<double> v, const DescentLimits&) {
  Descent descent{.v = std::move(v), .value = 0.0, .note = "gave up"};
  descent.value = function(descent.v, {});
  descent.evaluations = 1, descent.failed = true;
  return descent;
}

const std::function<void(double)> kUnheard;

SearchSettings settings_for(int wavelengths, Minimise minimise) {
  return {wavelengths, 1, search_plan(wavelengths, 8, 25), nullptr, std::move(minimise)};
}

/// The worst that could come of a search: random densities, roughly those of the wrong wavelengths.
WavelengthDistribution poor(const TabulatedSpectrum& emission, int wavelengths, const Targets& targets) {
  WavelengthDistribution distribution = test::random_distribution(emission, wavelengths, 12, 3);
  distribution.value = 1e9;
  judge_baselines(distribution, targets);
  return distribution;
}

// Even where no descent moves, what comes out is as good as the samplers that need no search.
TEST(CatchUp, EndsNoWorseThanTheBaselinesWhateverTheSearchFound) {
  std::vector<std::pair<std::string, TabulatedSpectrum>> lamps{
      {"line", tabulate_emission(LineSpectrum{546.1, 0.01})}};
  for (const char* name : {"A", "D65", "FL11", "HP1", "LED-V1"})
    lamps.emplace_back(name, tabulate_emission(*cie_illuminant(name)));
  for (const auto& [name, emission] : lamps)
    for (const int wavelengths : {1, 2, 4, 7, 16}) {
      const Targets targets = targets_for(emission);
      const SearchSettings settings = settings_for(wavelengths, give_up);
      Selected best{poor(emission, wavelengths, targets)};
      SearchProgress progress(kUnheard, settings.plan, 1);
      catch_up(best, targets, settings, progress);
      const WavelengthDistribution& found = best.distribution;
      EXPECT_LE(found.value, found.illuminant_value * (1.0 + 1e-9)) << name << ", " << wavelengths;
      EXPECT_LE(found.value, found.visible_value * (1.0 + 1e-5)) << name << ", " << wavelengths;
      const Xyz mean = test::mean_estimate(OptimizedWavelengths(found), emission);
      EXPECT_NEAR(mean.y / emission_xyz(emission, Observer::cie1931()).y, 1.0, 1e-5) << name;
    }
}

// What takes the place of a found distribution tells of its own descent.
TEST(CatchUp, TellsThatTheSolverGaveUp) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  const Targets targets = targets_for(emission);
  const SearchSettings settings = settings_for(4, give_up);
  Selected best{poor(emission, 4, targets)};
  best.distribution.illuminant_value = best.distribution.visible_value = 1e6;  // one descent is enough
  SearchProgress progress(kUnheard, settings.plan, 1);
  catch_up(best, targets, settings, progress);
  EXPECT_TRUE(best.failed);
  EXPECT_EQ(best.note, "gave up");
}

TEST(CatchUp, DescendsFromTheBaselinesFirst) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  const Targets targets = targets_for(emission);
  const SearchSettings settings = settings_for(4, descend);
  Selected best{poor(emission, 4, targets), true, "a descent that is given up for a better one"};
  const WavelengthDistribution& found = best.distribution;
  const double visible = found.visible_value;
  SearchProgress progress(kUnheard, settings.plan, 1);
  catch_up(best, targets, settings, progress);
  EXPECT_FALSE(best.failed);
  EXPECT_NE(best.note, "a descent that is given up for a better one");
  EXPECT_LT(found.value, 0.8 * found.illuminant_value);
  EXPECT_FALSE(found.stepped);
  EXPECT_GT(progress.evaluations(), 10);
  EXPECT_EQ(found.visible_value, visible) << "the baselines' values stay";
}

TEST(CatchUp, LeavesWhatIsBetterAlone) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  Selected best{test::random_distribution(emission, 4, 12, 3), true, "its own end"};
  WavelengthDistribution& good = best.distribution;
  good.value = 1.0, good.illuminant_value = 2.0, good.visible_value = 3.0;
  const SearchSettings settings = settings_for(4, give_up);
  SearchProgress progress(kUnheard, settings.plan, 1);
  catch_up(best, targets_for(emission), settings, progress);
  EXPECT_EQ(good.value, 1.0);
  EXPECT_TRUE(best.failed);
  EXPECT_EQ(progress.evaluations(), 0);
}

// A failure on the last level is told, and the point kept.
TEST(Search, TellsThatTheSolverGaveUp) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  const Targets targets = targets_for(emission);
  const PiecewiseLinearDensity base = base_density(emission, 0.02, 0.3);
  const auto loss = std::make_shared<const EstimateLoss>(targets, base);
  for (const bool failing : {true, false}) {
    const SearchSettings settings = settings_for(4, failing ? Minimise(give_up) : Minimise(descend));
    SearchProgress progress(kUnheard, settings.plan, 1);
    const std::vector<Found> pool = search(loss, settings, progress);
    const Selected best = best_of(pool, base, targets);
    EXPECT_EQ(best.failed, failing);
    if (failing) {
      EXPECT_EQ(best.note, "gave up");
    }
    EXPECT_TRUE(std::isfinite(best.distribution.value));
    EXPECT_LT(best.distribution.value, 1.5 * pool[0].candidate.value);
  }
}

// Values that are no numbers from the third evaluation on, on every descent.
TEST(Search, SurvivesNumbersThatBreakDown) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("FL11"));
  const Targets targets = targets_for(emission);
  const PiecewiseLinearDensity base = base_density(emission);
  const auto breaking = [](const Differentiable& function, std::vector<double> v,
                           const DescentLimits& limits) {
    int calls = 0;
    return descend(
        [&](std::span<const double> x, std::span<double> gradient) {
          const double value = function(x, gradient);
          return ++calls < 3 ? value : std::nan("");
        },
        std::move(v), limits);
  };
  const SearchSettings settings = settings_for(4, breaking);
  SearchProgress progress(kUnheard, settings.plan, 1);
  Selected best =
      best_of(search(std::make_shared<const EstimateLoss>(targets, base), settings, progress), base, targets);
  WavelengthDistribution& found = best.distribution;
  EXPECT_TRUE(std::isfinite(found.value));
  judge_baselines(found, targets);
  catch_up(best, targets, settings, progress);
  EXPECT_LE(found.value, found.illuminant_value * (1.0 + 1e-9));
}

}  // namespace
}  // namespace photopic
