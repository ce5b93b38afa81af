#include "optimize/search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <random>
#include <utility>

#include "optimize/solver.h"

namespace photopic {
namespace {

double cost(const SearchLevel& level) {
  return static_cast<double>(level.strata) * level.evaluations;
}

/// Every candidate has a generator of its own, so that neither the threads nor the number of starts change
/// it.
Candidate start(int index, const SearchSettings& settings) {
  std::seed_seq seeds{static_cast<std::uint32_t>(settings.seed),
                      static_cast<std::uint32_t>(settings.seed >> 32), static_cast<std::uint32_t>(index)};
  Random random(seeds);
  return random_candidate(settings.wavelengths, settings.plan[0].nodes, random);
}

}  // namespace

SearchProgress::SearchProgress(const std::function<void(double)>& report,
                               const std::vector<SearchLevel>& plan, std::size_t searches)
    : report_(report), total_(cost(plan.back())) {
  for (const SearchLevel& level : plan) total_ += level.candidates * cost(level);
  total_ *= static_cast<double>(searches);
}

void SearchProgress::done(const SearchLevel& level, int evaluations) {
  const std::lock_guard lock(mutex_);
  evaluations_ += evaluations;
  if (report_) report_(std::min(1.0, (done_ += cost(level)) / total_));
}

void check_stop(const std::atomic<bool>* stop) {
  if (stop && stop->load(std::memory_order_relaxed)) throw SearchStopped();
}

Found improve(const Candidate& candidate, const std::shared_ptr<const EstimateLoss>& loss,
              const SearchLevel& level, const SearchSettings& settings) {
  check_stop(settings.stop);
  ObjectiveFunction objective(loss, candidate.backwards, candidate.nodes(), level.strata);
  Descent descent = settings.minimise(
      [&](std::span<const double> v, std::span<double> gradient) { return objective(v, gradient); },
      candidate.v, {.evaluations = level.evaluations, .tolerance = level.tolerance, .stop = settings.stop});
  check_stop(settings.stop);
  return {{candidate.backwards, std::move(descent.v), descent.value},
          descent.evaluations,
          descent.failed,
          std::move(descent.note)};
}

std::vector<Found> search(const std::shared_ptr<const EstimateLoss>& loss, const SearchSettings& settings,
                          SearchProgress& progress) {
  std::vector<Found> pool(settings.plan[0].candidates);
  for (int i = 0; i < settings.plan[0].candidates; ++i) pool[i].candidate = start(i, settings);
  for (const SearchLevel& level : settings.plan) {
    if (level.candidates < static_cast<int>(pool.size())) pool.resize(level.candidates);
    for (Found& found : pool) found.candidate = resampled(found.candidate, level.nodes);
    if (&level == &settings.plan.back())
      pool.push_back({.candidate = equal_strata(settings.wavelengths, level.nodes)});
    tbb::parallel_for(std::size_t{0}, pool.size(), [&](std::size_t i) {
      pool[i] = improve(pool[i].candidate, loss, level, settings);
      progress.done(level, pool[i].evaluations);
    });
    std::stable_sort(pool.begin(), pool.end(),
                     [](const Found& a, const Found& b) { return a.candidate.value < b.candidate.value; });
  }
  return pool;
}

}  // namespace photopic
