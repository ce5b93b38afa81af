#pragma once

#include "spectral/color.h"
#include "spectral/spectrum.h"

namespace photopic {

/// The colour of a reflectance under D65 (CIE 1931), linear sRGB, unclipped; of a constant exactly that grey.
Rgb color_under_d65(const Spectrum& reflectance);

}  // namespace photopic
