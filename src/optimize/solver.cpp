#include "optimize/solver.h"

#include <nlopt.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "optimize/candidate.h"
#include "optimize/reflectance_set.h"
#include "optimize/sampler_value.h"
#include "optimize/search_plan.h"
#include "spectral/lamp_set.h"

namespace photopic {
namespace {

constexpr double kLowest = -18.0, kHighest = 5.0;  ///< bounds of v
constexpr int kTargets = 48;
constexpr unsigned kMemory = 20;  ///< steps that L-BFGS remembers; NLopt's own choice is hundreds, and slow

/// What NLopt calls: remembers the best point, since NLopt may end anywhere and report a failure.
struct Descent {
  ObjectiveFunction function;
  std::vector<double> best;
  double best_value = std::numeric_limits<double>::infinity();
  int evaluations = 0;

  double operator()(std::span<const double> v, std::span<double> gradient) {
    ++evaluations;
    const double value = function(v, gradient);
    if (!std::isfinite(value)) return HUGE_VAL;
    if (value < best_value) best_value = value, best.assign(v.begin(), v.end());
    return value;
  }

  static double call(unsigned count, const double* v, double* gradient, void* self) {
    return (*static_cast<Descent*>(self))({v, count}, {gradient, gradient ? count : 0});
  }
};

struct Outcome {
  int evaluations = 0;
  bool failed = false;
  std::string note;
};

/// Descends from a candidate by L-BFGS; it becomes the best point met.
Outcome descend(Candidate& candidate, const std::shared_ptr<const EstimateLoss>& loss,
                const SearchLevel& level) {
  for (double& x : candidate.v) x = std::clamp(x, kLowest, kHighest);
  Descent descent{{loss, candidate.backwards, candidate.nodes(), level.strata}, candidate.v};

  const auto count = static_cast<unsigned>(candidate.v.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> solver(nlopt_create(NLOPT_LD_LBFGS, count),
                                                                 nlopt_destroy);
  if (!solver) throw std::bad_alloc();
  nlopt_set_min_objective(solver.get(), Descent::call, &descent);
  nlopt_set_lower_bounds1(solver.get(), kLowest);
  nlopt_set_upper_bounds1(solver.get(), kHighest);
  nlopt_set_maxeval(solver.get(), level.evaluations);
  nlopt_set_vector_storage(solver.get(), kMemory);
  nlopt_set_ftol_rel(solver.get(), level.tolerance);

  std::vector<double> v = candidate.v;
  double value = 0.0;
  const nlopt_result result = nlopt_optimize(solver.get(), v.data(), &value);
  candidate.v = std::move(descent.best);
  candidate.value = descent.best_value;
  const bool failed = result < 0 && result != NLOPT_ROUNDOFF_LIMITED;
  return {descent.evaluations, failed, nlopt_result_to_string(result)};
}

/// Tells how far the search is, from any thread.
class Progress {
 public:
  Progress(const std::function<void(double)>& report, const std::vector<SearchLevel>& plan,
           std::size_t searches)
      : report_(report), total_(cost(plan.back())) {
    for (const SearchLevel& level : plan) total_ += level.candidates * cost(level);
    total_ *= static_cast<double>(searches);
  }
  void done(const SearchLevel& level) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    report_(std::min(1.0, (done_ += cost(level)) / total_));
  }

 private:
  static double cost(const SearchLevel& level) {
    return static_cast<double>(level.strata) * level.evaluations;
  }
  const std::function<void(double)>& report_;
  std::mutex mutex_;
  double done_ = 0.0, total_;
};

std::vector<SearchLevel> plan_for(const OptimizeOptions& options) {
  const int starts = options.effort == Effort::quick ? 64 : options.effort == Effort::normal ? 512 : 4096;
  if (options.objective == Objective::asymptotic) return search_plan(options.wavelengths, starts);
  // A ΔE00 of its own for each stratum makes an evaluation ten times as dear.
  std::vector<SearchLevel> plan = search_plan(options.wavelengths, starts / 4);
  plan.back().evaluations /= 4;
  return plan;
}

/// Every candidate has a generator of its own, so that neither the threads nor the number of starts change
/// it.
Candidate start(int index, int nodes, const OptimizeOptions& options) {
  std::seed_seq seeds{static_cast<std::uint32_t>(options.seed),
                      static_cast<std::uint32_t>(options.seed >> 32), static_cast<std::uint32_t>(index)};
  Random random(seeds);
  return random_candidate(options.wavelengths, nodes, random);
}

WavelengthDistribution to_distribution(const PiecewiseLinearDensity& base, const Candidate& candidate) {
  WavelengthDistribution distribution{.base = base, .components = {}};
  const int nodes = candidate.nodes();
  for (int k = 0; k < candidate.wavelengths(); ++k) {
    WavelengthDistribution::Component component{{}, candidate.backwards[k]};
    for (int b = 0; b < nodes; ++b) component.nodes.push_back(std::exp(candidate.v[k * nodes + b]));
    distribution.components.push_back(std::move(component));
  }
  return distribution;
}

/// A candidate, and what its last descent said.
struct Found {
  Candidate candidate;
  Outcome outcome;
};

/// The last level's candidates, the best first.
std::vector<Found> search(const std::shared_ptr<const EstimateLoss>& loss,
                          const std::vector<SearchLevel>& plan, const OptimizeOptions& options,
                          Progress& progress, int& evaluations) {
  std::vector<Found> pool(plan[0].candidates);
  for (int i = 0; i < plan[0].candidates; ++i) pool[i].candidate = start(i, plan[0].nodes, options);
  for (const SearchLevel& level : plan) {
    if (level.candidates < static_cast<int>(pool.size())) pool.resize(level.candidates);
    for (Found& found : pool) found.candidate = resampled(found.candidate, level.nodes);
    if (&level == &plan.back()) pool.push_back({equal_strata(options.wavelengths, level.nodes), {}});
    tbb::parallel_for(std::size_t{0}, pool.size(), [&](std::size_t i) {
      pool[i].outcome = descend(pool[i].candidate, loss, level);
      progress.done(level);
    });
    for (const Found& found : pool) evaluations += found.outcome.evaluations;
    std::stable_sort(pool.begin(), pool.end(),
                     [](const Found& a, const Found& b) { return a.candidate.value < b.candidate.value; });
  }
  return pool;
}

/// Fills in the baselines' values, each as its own sampler.
void judge_baselines(WavelengthDistribution& distribution, const Targets& targets) {
  const int count = static_cast<int>(distribution.components.size());
  const WavelengthSampler samplers[] = {IlluminantWavelengths{count, base_density(targets.mixed)},
                                        VisibleWavelengths{count}, UniformWavelengths{count}};
  double* const values[] = {&distribution.illuminant_value, &distribution.visible_value,
                            &distribution.uniform_value};
  tbb::parallel_for(0, 3, [&](int i) { *values[i] = sampler_value(samplers[i], targets); });
}

/// The shares of sech² in the base densities that are tried. Lines ask for little of it; many wavelengths
/// under a smooth lamp for nearly nothing else.
std::vector<double> visible_shares(const OptimizeOptions& options) {
  if (options.wavelengths <= 2) return {0.0, 0.3};
  return options.wavelengths <= 4 ? std::vector{0.3} : std::vector{0.3, 0.9};
}

Targets make_targets(std::span<const TabulatedSpectrum> emissions, const OptimizeOptions& options) {
  return {options.objective,
          options.white,
          mixed_light(emissions),
          {emissions.begin(), emissions.end()},
          target_reflectances(kTargets, options.seed)};
}

/// A candidate as a distribution, judged by its spectra.
WavelengthDistribution judged(const PiecewiseLinearDensity& base, const Candidate& candidate,
                              const Targets& targets) {
  WavelengthDistribution distribution = to_distribution(base, candidate);
  distribution.value = sampler_value(OptimizedWavelengths(distribution), targets);
  distribution.objective = targets.objective == Objective::asymptotic ? "asymptotic" : "mean-delta-e";
  distribution.spectrum_digest = digest(targets.emitters);
  return distribution;
}

/// The best of a search, by its judge: a density with a needle between two strata of u can fool the
/// objective.
/// @return its place in the pool, and the distribution
std::pair<std::size_t, WavelengthDistribution> best_of(const std::vector<Found>& pool,
                                                       const PiecewiseLinearDensity& base,
                                                       const Targets& targets) {
  constexpr double kClose = 1.1;  // a few per cent between objective and judge are what the tables cost
  std::size_t place = 0;
  WavelengthDistribution best = judged(base, pool[0].candidate, targets);
  for (std::size_t i = 1; i < pool.size() && best.value > kClose * pool[i].candidate.value; ++i) {
    WavelengthDistribution next = judged(base, pool[i].candidate, targets);
    if (next.value < best.value) place = i, best = std::move(next);
  }
  return {place, std::move(best)};
}

/// The best on one base density, or its equal strata where nothing is better.
OptimizeResult search_with(const PiecewiseLinearDensity& base, const Targets& targets,
                           const std::vector<SearchLevel>& plan, const OptimizeOptions& options,
                           Progress& progress, int& evaluations) {
  const auto loss = std::make_shared<const EstimateLoss>(targets, base);
  const std::vector<Found> pool = search(loss, plan, options, progress, evaluations);
  auto [place, best] = best_of(pool, base, targets);
  OptimizeResult result{
      .distribution = std::move(best),
      .initial = judged(base, equal_strata(options.wavelengths, plan.back().nodes), targets),
      .solver_failed = pool[place].outcome.failed,
      .solver_note = pool[place].outcome.note};
  if (result.initial.value < result.distribution.value) result.distribution = result.initial;
  return result;
}

/// Where the search found nothing as good as the `illuminant` or the `visible` sampler: descends from these,
/// and if that is not enough takes them as they are. Both are N equal strata of a density that a base can be
/// (for `visible`, u_j = frac(u + j/N) visits the same sets of N wavelengths as the strata do). Finer nodes
/// make the strata's edges steeper and so come nearer to the sampler itself.
void catch_up(OptimizeResult& result, const Targets& targets, const SearchLevel& level, int& evaluations) {
  constexpr int kSteepest = 8192;
  WavelengthDistribution& best = result.distribution;
  const double baseline = std::min(best.illuminant_value, best.visible_value);
  const auto take = [&](WavelengthDistribution better) {
    if (!(better.value < best.value)) return;
    better.illuminant_value = best.illuminant_value;
    better.visible_value = best.visible_value;
    better.uniform_value = best.uniform_value;
    best = std::move(better);
  };
  const int wavelengths = static_cast<int>(best.components.size());
  const PiecewiseLinearDensity bases[] = {base_density(targets.mixed), base_density(targets.mixed, 0.0, 1.0)};
  for (const PiecewiseLinearDensity& base : bases) {
    if (best.value <= baseline) return;
    Candidate candidate = equal_strata(wavelengths, level.nodes);
    const auto loss = std::make_shared<const EstimateLoss>(targets, base);
    evaluations += descend(candidate, loss, level).evaluations;
    take(judged(base, candidate, targets));
  }
  for (int nodes = 2 * level.nodes; nodes <= kSteepest; nodes *= 2)
    for (const PiecewiseLinearDensity& base : bases)
      if (best.value > baseline) take(judged(base, equal_strata(wavelengths, nodes), targets));
}

}  // namespace

OptimizeResult optimize_distribution(std::span<const TabulatedSpectrum> emissions,
                                     const OptimizeOptions& options,
                                     const std::function<void(double)>& report) {
  if (emissions.empty()) throw std::invalid_argument("there is no emission to optimise for");
  if (options.wavelengths < 1 || options.wavelengths > 16)
    throw std::invalid_argument("the number of wavelengths lies between 1 and 16");
  const auto begin = std::chrono::steady_clock::now();

  const Targets targets = make_targets(emissions, options);
  const std::vector<SearchLevel> plan = plan_for(options);
  const std::vector<double> shares = visible_shares(options);
  Progress progress(report, plan, shares.size());

  std::optional<OptimizeResult> best;
  int evaluations = 0;
  for (const double share : shares) {
    OptimizeResult result =
        search_with(base_density(targets.mixed, 0.02, share), targets, plan, options, progress, evaluations);
    if (!best || result.distribution.value < best->distribution.value) best = std::move(result);
  }
  OptimizeResult& result = *best;
  judge_baselines(result.distribution, targets);
  catch_up(result, targets, plan.back(), evaluations);
  result.evaluations = evaluations;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return std::move(*best);
}

OptimizeResult optimize_distribution(const TabulatedSpectrum& emission, const OptimizeOptions& options,
                                     const std::function<void(double)>& report) {
  return optimize_distribution(std::span(&emission, 1), options, report);
}

}  // namespace photopic
