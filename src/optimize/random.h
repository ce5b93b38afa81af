#pragma once

#include <random>

namespace photopic {

/// The same numbers on every machine, which the standard's distributions do not promise.
using Random = std::mt19937_64;

/// Uniform in [0, 1).
inline double uniform(Random& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace photopic
