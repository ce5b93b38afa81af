#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "optimize/solver.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// Optimises with a progress line, and warns when the solver gave up.
/// @param name the lamp's, for the distribution's file
OptimizeResult optimize_with_progress(const TabulatedSpectrum& emission, const std::string& name,
                                      const OptimizeOptions& options, bool quiet);

/// Writes the color bar of some samplers under a lamp.
/// @throws InputError when it cannot be written
void write_color_bar(const std::filesystem::path& file, std::span<const WavelengthSampler> samplers,
                     const TabulatedSpectrum& emission);

}  // namespace photopic
