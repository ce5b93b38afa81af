#pragma once

#include <span>
#include <vector>

#include "spectral/spectrum.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// Linear sRGB pixels, row by row.
struct ColorBar {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;
};

/// What a single path sees of a white surface (R = 1) under a lamp, from u = 0 at the left to 1 at the right:
/// a block of rows for each sampler, and at the bottom the lamp's true colour. The less a block differs from
/// it, the better. The lamp's luminance is scaled to `luminance`, so that estimates above the mean need not
/// clip.
ColorBar color_bar(std::span<const WavelengthSampler> samplers, const TabulatedSpectrum& emission,
                   int width = 1024, int rows_per_block = 64, double luminance = 0.5);

}  // namespace photopic
