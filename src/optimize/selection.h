#pragma once

#include <vector>

#include "optimize/objective.h"
#include "optimize/search.h"
#include "spectral/wavelength_distribution.h"

namespace photopic {

/// A candidate as a distribution, judged by its spectra. What it was made for is filled in but for the
/// baselines' values and what the caller alone knows (`spectrum`, `targets`, `optimize_seconds`).
WavelengthDistribution judged(const PiecewiseLinearDensity& base, const Candidate& candidate,
                              const Targets& targets);

/// A distribution, and how the descent that it comes from ended.
struct Selected {
  WavelengthDistribution distribution;
  bool failed = false;  ///< NLopt gave up on it
  std::string note = {};
};

/// The best of a search, by its judge: a density with a needle between two strata of u can fool the
/// objective.
/// @param pool not empty, the best first
Selected best_of(const std::vector<Found>& pool, const PiecewiseLinearDensity& base, const Targets& targets);

/// Fills in the baselines' values, each as its own sampler.
void judge_baselines(WavelengthDistribution& distribution, const Targets& targets);

/// Where a distribution, its baselines judged, is worse than the `illuminant` or the `visible` sampler:
/// descends from these, and if that is not enough takes them as they are. Both are N equal strata of a
/// density that a base can be (for `visible`, u_j = frac(u + j/N) visits the same sets of N wavelengths as
/// the strata do), and a stepped distribution is such strata exactly. So afterwards the value is that of
/// `illuminant` at the most, and that of `visible`, whose density the base tabulates every nm, within 1e-5 of
/// it.
/// @throws SearchStopped
void catch_up(Selected& best, const Targets& targets, const SearchSettings& settings,
              SearchProgress& progress);

}  // namespace photopic
