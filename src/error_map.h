#pragma once

#include <filesystem>
#include <vector>

#include "core/image_io.h"
#include "spectral/color.h"

namespace photopic {

/// What is white in a map of 8 bits; more looks no brighter.
inline constexpr double kBrightestDeltaE = 10.0;

/// A ΔE on a scale of colours from black over violet, red and yellow to white at kBrightestDeltaE: CIELAB's
/// lightness is proportional to it.
Rgb error_color(double delta_e);

/// Checks before images are read that `file` can be written, and that its ending is .exr or .png.
/// @throws InputError
void check_writable_map(const std::filesystem::path& file);

/// Writes ΔE of every pixel: to an .exr as it is, in one channel called dE; to a .png as error_color has it,
/// magenta where it is not known.
/// @param shape of the images that were compared
/// @throws InputError when the file cannot be written
void write_error_map(const std::filesystem::path& file, const ImageShape& shape,
                     const std::vector<double>& delta_e, const Metadata& metadata);

}  // namespace photopic
