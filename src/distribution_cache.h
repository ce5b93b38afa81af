#pragma once

#include <span>
#include <string>

#include "optimize/solver.h"

namespace photopic {

/// The distribution of a lamp_set (`name` is the lamps') from $XDG_CACHE_HOME/photopic (~/.cache/photopic);
/// optimised and put there when it is not in it. Files are called by what they depend on and appear whole, so
/// that runs side by side do not disturb each other. A damaged file is reported in one warning and made anew;
/// without a home folder there is no cache.
WavelengthDistribution cached_distribution(std::span<const TabulatedSpectrum> lamps, const std::string& name,
                                           const OptimizeOptions& options, bool use_cache, bool quiet);

}  // namespace photopic
