#pragma once

#include "optimize/solver.h"

namespace photopic::test {

/// The least effort.
inline OptimizeResult quick(const TabulatedSpectrum& emission, int wavelengths = 4,
                            Objective objective = Objective::asymptotic) {
  OptimizeOptions options;
  options.wavelengths = wavelengths;
  options.objective = objective;
  options.effort = Effort::quick;
  return optimize_distribution(emission, options);
}

}  // namespace photopic::test
