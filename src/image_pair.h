#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/image_io.h"

namespace photopic {

/// What an image and the reference it is measured against must share.

/// Where an image lies in the whole picture, as --crop takes it: "X0,Y0,X1,Y1".
std::string window_text(const ImageShape& image);

/// The part of `whole` that `part` says it is a window of; nothing where it says no such thing.
std::optional<Image> matching_part(const ImageShape& part, const Image& whole);

/// @throws InputError when `image` (called `name`) has another size than the reference, or both tell which
/// window of a picture they are, and it is another
void check_same_pixels(const ImageShape& reference, const ImageShape& image, const std::string& name);

/// Warns of an image whose seed and sampler are those that the reference's metadata tell of: errors would
/// come out too small. Metadata that do not tell are taken for others'.
void warn_of_shared_noise(const Metadata& reference, const std::string& name, const Metadata& image);

/// Warns of an image that by its metadata and the reference's shows other light, or by another eye: their
/// difference is no error. What one of the two does not tell is taken to be the same.
void warn_of_other_light(const Metadata& reference, const std::string& name, const Metadata& image);

/// Warns of a reference whose ending is that of an 8-bit image: measures are of linear, unclipped colours.
void warn_of_8_bit_reference(const std::filesystem::path& file);

}  // namespace photopic
