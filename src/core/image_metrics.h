#pragma once

#include <cstddef>
#include <vector>

#include "core/image_io.h"
#include "spectral/color.h"

namespace photopic {

/// How far an image is from its reference. Pixels with a NaN or infinity in either are counted and left out
/// of the rest, which is NaN when no pixel remains.
struct ImageDifference {
  double mean_delta_e = 0, median_delta_e = 0, p95_delta_e = 0, max_delta_e = 0;  ///< CIEDE2000 over pixels
  double mse = 0;     ///< mean over pixels and channels of (image − reference)², linear sRGB
  double relmse = 0;  ///< mean over pixels and channels of (image − reference)² / (reference² + 0.01)
  std::size_t non_finite = 0;  ///< pixels
};

/// CIEDE2000 of every pixel, row by row, as compare_images takes it; NaN where one of the two is not finite.
/// @param image of the reference's size
std::vector<double> delta_e_map(const Image& reference, const Image& image, Xyz white = d65_white());

/// ΔE of unclipped linear sRGB at 0 EV, relative to `white` (XYZ). Percentiles are interpolated between order
/// statistics.
/// @throws std::invalid_argument when the sizes differ
ImageDifference compare_images(const Image& reference, const Image& image, Xyz white = d65_white());

}  // namespace photopic
