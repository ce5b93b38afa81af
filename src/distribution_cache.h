#pragma once

#include <string>

#include "optimize/solver.h"

namespace photopic {

struct CachedDistribution {
  WavelengthDistribution distribution;
  double optimize_seconds = 0;  ///< 0 when it was in the cache
};

/// A lamp's distribution (`lamp` is its name) from $XDG_CACHE_HOME/photopic (~/.cache/photopic); optimised
/// and put there when it is not in it. Files are called by what they depend on and appear whole, so that runs
/// side by side do not disturb each other. A damaged file is reported in one warning and made anew; without a
/// home folder there is no cache.
CachedDistribution cached_distribution(const TabulatedSpectrum& emission, const std::string& lamp,
                                       const OptimizeOptions& options, bool use_cache, bool quiet);

}  // namespace photopic
