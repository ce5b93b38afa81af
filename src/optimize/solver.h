#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "optimize/objective.h"
#include "spectral/wavelength_distribution.h"

namespace photopic {

/// How many starts the search makes. At 4 wavelengths about 0.2, 0.8 and 6 seconds of one processor core.
enum class Effort { quick, normal, thorough };

struct OptimizeOptions {
  int wavelengths = 4;  ///< 1 … 16
  Objective objective = Objective::asymptotic;
  White white = White::d65;
  std::uint64_t seed = 1;
  Effort effort = Effort::normal;
  int nodes = 0;                       ///< of each density, 3 … 1025; 0: 193
  int target_count = 48;               ///< target_reflectances(), R = 1 the first of them; ≥ 1
  std::vector<Spectrum> reflectances;  ///< further targets, measured; Objective::asymptotic alone sees them
  const std::atomic<bool>* stop = nullptr;  ///< once true, the search ends soon with SearchStopped
};

/// The search was ended by OptimizeOptions::stop; there is no result.
struct SearchStopped : std::runtime_error {
  SearchStopped() : std::runtime_error("the search was stopped") {}
};

struct OptimizeResult {
  WavelengthDistribution distribution;  ///< `spectrum` and the measured targets' name are left to the caller
  WavelengthDistribution
      initial;                 ///< N strata of equal probability: the illuminant sampler on this base density
  int evaluations = 0;         ///< of the objective, with its gradient
  double seconds = 0;          ///< of wall clock
  bool solver_failed = false;  ///< NLopt gave up on a final descent; the best point it saw was kept
  std::string solver_note;     ///< what NLopt said of it
};

/// Searches the N densities for one lamp or several, a lamp_set: the base density is that of their sum, and
/// every reflectance is a target under every lamp, weighted by the lamp's luminance (Objective::mean_delta_e
/// sees R = 1 under the sum). Deterministic: the same emissions, options and build give the same result,
/// whatever the number of threads; the budget is counted in evaluations. Never worse by its own objective
/// than the `illuminant` and `visible` samplers, by construction: see catch_up.
/// @param progress is told the part done, 0 … 1, from any thread, one at a time
/// @throws std::invalid_argument when the emissions have no luminance or the options are out of range
/// @throws SearchStopped
OptimizeResult optimize_distribution(std::span<const TabulatedSpectrum> emissions,
                                     const OptimizeOptions& options,
                                     const std::function<void(double fraction)>& progress = {});

}  // namespace photopic
