#pragma once

#include <span>
#include <string>

#include "spectral/spectrum.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// color_bar() with labels, an SVG file's text: a bar over u from 0 to 1 for each sampler, its name at the
/// left, and the lamp's true colour below. Colours beyond sRGB are clipped.
/// @param title the lamp's name
std::string color_bar_plot(const std::string& title, std::span<const WavelengthSampler> samplers,
                           const TabulatedSpectrum& emission);

}  // namespace photopic
