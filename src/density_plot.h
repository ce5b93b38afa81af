#pragma once

#include <string>

#include "spectral/spectrum.h"
#include "spectral/wavelength_distribution.h"

namespace photopic {

/// The picture of an optimisation, an SVG file's text of 900 × 830 pixels: above, the lamp's spectrum and the
/// N densities over wavelength; below, what one path of u estimates of X, Y, Z for R = 1, before and after.
/// @param initial the strata that the search improves on  @param light the lamps together
std::string density_plot(const WavelengthDistribution& initial, const WavelengthDistribution& optimized,
                         const TabulatedSpectrum& light);

}  // namespace photopic
