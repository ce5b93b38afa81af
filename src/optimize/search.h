#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "optimize/candidate.h"
#include "optimize/descent.h"
#include "optimize/objective.h"
#include "optimize/search_plan.h"

namespace photopic {

/// What improves a point; a test puts something else in descend()'s place.
using Minimise = std::function<Descent(const Differentiable&, std::vector<double>, const DescentLimits&)>;

/// What all searches of an optimisation share.
struct SearchSettings {
  int wavelengths;
  std::uint64_t seed;
  std::vector<SearchLevel> plan;
  const std::atomic<bool>* stop = nullptr;
  Minimise minimise = descend;
};

/// A candidate, and how its last descent ended.
struct Found {
  Candidate candidate;
  int evaluations = 0;
  bool failed = false;
  std::string note = {};
};

/// Counts evaluations and tells how far the searches are, from any thread, one at a time.
class SearchProgress {
 public:
  /// @param report may be empty; must outlive this  @param searches that will follow the plan
  SearchProgress(const std::function<void(double fraction)>& report, const std::vector<SearchLevel>& plan,
                 std::size_t searches);
  void done(const SearchLevel& level, int evaluations);
  int evaluations() const { return evaluations_; }  ///< of the objective; to be asked between searches

 private:
  const std::function<void(double)>& report_;
  std::mutex mutex_;
  int evaluations_ = 0;
  double done_ = 0.0, total_;
};

/// @throws SearchStopped when the flag is set
void check_stop(const std::atomic<bool>* stop);

/// Descends from a candidate on one level.
/// @throws SearchStopped
Found improve(const Candidate& candidate, const std::shared_ptr<const EstimateLoss>& loss,
              const SearchLevel& level, const SearchSettings& settings);

/// Many random starts, level by level, in parallel; on the last level equal strata join them.
/// @return the last level's candidates, the best first  @throws SearchStopped
std::vector<Found> search(const std::shared_ptr<const EstimateLoss>& loss, const SearchSettings& settings,
                          SearchProgress& progress);

}  // namespace photopic
