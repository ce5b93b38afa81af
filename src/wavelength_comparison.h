#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "optimize/sampler_report.h"
#include "optimize/solver.h"

namespace photopic {

/// What N wavelengths a path bring: the optimised densities, and the best sampler that needs none.
struct WavelengthRow {
  int wavelengths = 0;
  SamplerReport optimized;
  std::string baseline;  ///< "uniform", "visible" or "illuminant": least error of 64 paths, reflectances
  SamplerReport best_baseline;
  double optimize_seconds = 0;  ///< wall clock
};

/// Optimises for N = 1, 2, 4, 8, 16 with otherwise the same options, and measures under the lamps together.
/// @param lamps a lamp_set  @throws SearchStopped
std::vector<WavelengthRow> compare_wavelength_counts(
    std::span<const TabulatedSpectrum> lamps, OptimizeOptions options,
    const std::function<OptimizeResult(const OptimizeOptions&)>& optimize);

/// The table for a terminal.
std::string wavelength_table(const std::vector<WavelengthRow>& rows);

/// An array with an object for each N.
nlohmann::ordered_json wavelengths_json(const std::vector<WavelengthRow>& rows);

}  // namespace photopic
