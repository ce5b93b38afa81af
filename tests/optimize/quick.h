#pragma once

#include "optimize/solver.h"

namespace photopic::test {

/// For one lamp.
inline OptimizeResult optimize_for(const TabulatedSpectrum& lamp, const OptimizeOptions& options,
                                   const std::function<void(double)>& progress = {}) {
  return optimize_distribution(std::span(&lamp, 1), options, progress);
}

/// The least effort.
inline OptimizeResult quick(const TabulatedSpectrum& emission, int wavelengths = 4,
                            Objective objective = Objective::asymptotic) {
  OptimizeOptions options;
  options.wavelengths = wavelengths;
  options.objective = objective;
  options.effort = Effort::quick;
  return optimize_for(emission, options);
}

}  // namespace photopic::test
