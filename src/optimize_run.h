#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "optimize/solver.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// Optimises with a progress line, and warns when the solver gave up.
/// @param lamps a lamp_set  @param name theirs, for the distribution's file, which the seconds go to, too
/// @throws SearchStopped
OptimizeResult optimize_with_progress(std::span<const TabulatedSpectrum> lamps, const std::string& name,
                                      const OptimizeOptions& options, bool quiet);

/// Writes the color bar of some samplers under a lamp.
/// @throws InputError when it cannot be written
void write_color_bar(const std::filesystem::path& file, std::span<const WavelengthSampler> samplers,
                     const TabulatedSpectrum& emission);

}  // namespace photopic
