#include "optimize/solver.h"

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "optimize/reflectance_set.h"
#include "optimize/search.h"
#include "optimize/selection.h"
#include "spectral/lamp_set.h"

namespace photopic {
namespace {

void check(std::span<const TabulatedSpectrum> emissions, const OptimizeOptions& options) {
  if (emissions.empty()) throw std::invalid_argument("there is no emission to optimise for");
  if (options.wavelengths < 1 || options.wavelengths > 16)
    throw std::invalid_argument("the number of wavelengths lies between 1 and 16");
  if (options.nodes != 0 && (options.nodes < 3 || options.nodes > 1025))
    throw std::invalid_argument("the number of nodes lies between 3 and 1025");
  if (options.target_count < 1) throw std::invalid_argument("there must be a target");
}

std::vector<SearchLevel> plan_for(const OptimizeOptions& options) {
  const int starts = options.effort == Effort::quick ? 64 : options.effort == Effort::normal ? 512 : 4096;
  if (options.objective == Objective::asymptotic)
    return search_plan(options.wavelengths, starts, options.nodes);
  // A ΔE00 of its own for each stratum makes an evaluation ten times as dear.
  std::vector<SearchLevel> plan = search_plan(options.wavelengths, starts / 4, options.nodes);
  plan.back().evaluations /= 4;
  return plan;
}

/// The shares of sech² in the base densities that are tried. Lines ask for little of it; many wavelengths
/// under a smooth lamp for nearly nothing else.
std::vector<double> visible_shares(const OptimizeOptions& options) {
  if (options.wavelengths <= 2) return {0.0, 0.3};
  return options.wavelengths <= 4 ? std::vector{0.3} : std::vector{0.3, 0.9};
}

Targets make_targets(std::span<const TabulatedSpectrum> emissions, const OptimizeOptions& options) {
  Targets targets{options.objective,
                  options.white,
                  mixed_light(emissions),
                  {emissions.begin(), emissions.end()},
                  target_reflectances(options.target_count, options.seed)};
  targets.reflectances.insert(targets.reflectances.end(), options.reflectances.begin(),
                              options.reflectances.end());
  return targets;
}

WavelengthDistribution::TargetRecord describe_targets(const OptimizeOptions& options) {
  const bool all = options.objective == Objective::asymptotic;
  return {.white = options.white == White::d65 ? "D65" : "illuminant",
          .constructed = all ? options.target_count : 1,
          .seed = options.seed,
          .measured = all ? static_cast<int>(options.reflectances.size()) : 0,
          .measured_digest = all ? reflectances_digest(options.reflectances) : ""};
}

/// What one base density leads to.
struct OnBase {
  Selected best;  ///< or its equal strata where nothing is better
  WavelengthDistribution initial;
};

OnBase search_with(const PiecewiseLinearDensity& base, const Targets& targets, const SearchSettings& settings,
                   SearchProgress& progress) {
  const auto loss = std::make_shared<const EstimateLoss>(targets, base);
  OnBase result{
      .best = best_of(search(loss, settings, progress), base, targets),
      .initial = judged(base, equal_strata(settings.wavelengths, settings.plan.back().nodes), targets)};
  if (result.initial.value < result.best.distribution.value) result.best = {result.initial};
  return result;
}

}  // namespace

OptimizeResult optimize_distribution(std::span<const TabulatedSpectrum> emissions,
                                     const OptimizeOptions& options,
                                     const std::function<void(double)>& report) {
  check(emissions, options);
  const auto begin = std::chrono::steady_clock::now();
  const Targets targets = make_targets(emissions, options);
  const SearchSettings settings{options.wavelengths, options.seed, plan_for(options), options.stop};
  const std::vector<double> shares = visible_shares(options);
  SearchProgress progress(report, settings.plan, shares.size());

  std::optional<OnBase> found;
  for (const double share : shares) {
    OnBase next =
        search_with(base_density(targets.mixed, kDefensiveShare, share), targets, settings, progress);
    if (!found || next.best.distribution.value < found->best.distribution.value) found = std::move(next);
  }
  Selected& best = found->best;
  judge_baselines(best.distribution, targets);
  catch_up(best, targets, settings, progress);
  best.distribution.targets = describe_targets(options);
  return {.distribution = std::move(best.distribution),
          .initial = std::move(found->initial),
          .evaluations = progress.evaluations(),
          .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          .solver_failed = best.failed,
          .solver_note = std::move(best.note)};
}

}  // namespace photopic
