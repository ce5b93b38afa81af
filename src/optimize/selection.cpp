#include "optimize/selection.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "optimize/sampler_value.h"
#include "spectral/lamp_set.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {
namespace {

void judge(WavelengthDistribution& distribution, const Targets& targets) {
  distribution.value = sampler_value(OptimizedWavelengths(distribution), targets);
  distribution.objective = targets.objective == Objective::asymptotic ? "asymptotic" : "mean-delta-e";
  distribution.spectrum_digest = digest(targets.emitters);
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

/// N equal strata of a base with vertical edges, judged.
WavelengthDistribution sharp_strata(const PiecewiseLinearDensity& base, int wavelengths,
                                    const Targets& targets) {
  WavelengthDistribution distribution{.base = base, .components = {}, .stepped = true};
  for (int k = 0; k < wavelengths; ++k) {
    WavelengthDistribution::Component component{std::vector<double>(wavelengths, 0.0)};
    component.nodes[k] = 1.0;
    distribution.components.push_back(std::move(component));
  }
  judge(distribution, targets);
  return distribution;
}

}  // namespace

WavelengthDistribution judged(const PiecewiseLinearDensity& base, const Candidate& candidate,
                              const Targets& targets) {
  WavelengthDistribution distribution = to_distribution(base, candidate);
  judge(distribution, targets);
  return distribution;
}

Selected best_of(const std::vector<Found>& pool, const PiecewiseLinearDensity& base, const Targets& targets) {
  constexpr double kClose = 1.1;  // a few per cent between objective and judge are what the tables cost
  std::size_t place = 0;
  WavelengthDistribution best = judged(base, pool[0].candidate, targets);
  for (std::size_t i = 1; i < pool.size() && best.value > kClose * pool[i].candidate.value; ++i) {
    WavelengthDistribution next = judged(base, pool[i].candidate, targets);
    if (next.value < best.value) place = i, best = std::move(next);
  }
  return {std::move(best), pool[place].failed, pool[place].note};
}

void judge_baselines(WavelengthDistribution& distribution, const Targets& targets) {
  const int count = static_cast<int>(distribution.components.size());
  const auto samplers = baseline_samplers(count, targets.mixed);
  const std::array values{&distribution.uniform_value, &distribution.visible_value,
                          &distribution.illuminant_value};
  tbb::parallel_for(std::size_t{0}, samplers.size(),
                    [&](std::size_t i) { *values[i] = sampler_value(samplers[i], targets); });
}

void catch_up(Selected& best, const Targets& targets, const SearchSettings& settings,
              SearchProgress& progress) {
  const WavelengthDistribution& found = best.distribution;
  const double baseline = std::min(found.illuminant_value, found.visible_value);
  const auto take = [&](Selected better) {
    if (!(better.distribution.value < found.value)) return;
    better.distribution.illuminant_value = found.illuminant_value;
    better.distribution.visible_value = found.visible_value;
    better.distribution.uniform_value = found.uniform_value;
    best = std::move(better);
  };
  const SearchLevel& level = settings.plan.back();
  const PiecewiseLinearDensity bases[] = {base_density(targets.mixed), base_density(targets.mixed, 0.0, 1.0)};
  for (const PiecewiseLinearDensity& base : bases) {
    if (found.value <= baseline) return;
    Found descent = improve(equal_strata(settings.wavelengths, level.nodes),
                            std::make_shared<const EstimateLoss>(targets, base), level, settings);
    progress.done(level, descent.evaluations);
    take({judged(base, descent.candidate, targets), descent.failed, std::move(descent.note)});
  }
  for (const PiecewiseLinearDensity& base : bases)
    if (found.value > baseline) take({sharp_strata(base, settings.wavelengths, targets)});
}

}  // namespace photopic
