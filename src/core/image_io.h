#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace photopic {

enum class ColorSpace { linear_srgb, xyz };

/// An image's size, and what it is a window of.
struct ImageShape {
  int width = 0, height = 0;
  int left = 0, top = 0;                ///< where it lies in the whole picture
  int full_width = 0, full_height = 0;  ///< the whole picture's size; 0: not told, as of all but EXR

  bool is_whole() const { return full_width == 0 || (width == full_width && height == full_height); }
};

/// Three interleaved channels, row by row from the top, unclipped.
struct Image : ImageShape {
  ColorSpace space = ColorSpace::linear_srgb;
  std::vector<float> pixels;  ///< 3·width·height

  Image() = default;
  Image(int w, int h, ColorSpace s = ColorSpace::linear_srgb)
      : ImageShape{w, h}, space(s), pixels(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* at(int x, int y) {
    return &pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(x))];
  }
  const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
  /// The i-th pixel.
  void set(std::size_t i, double a, double b, double c) {
    pixels[3 * i] = static_cast<float>(a);
    pixels[3 * i + 1] = static_cast<float>(b);
    pixels[3 * i + 2] = static_cast<float>(c);
  }
};

using Metadata = std::map<std::string, std::string>;

/// Further channels of an EXR.
struct ImageLayer {
  std::vector<std::string> channels;  ///< their full names, as "depth.Z"
  Metadata metadata;                  ///< what the file shall say of them
  /// The values of a pixel (y·width + x), one a channel.
  std::function<void(std::size_t pixel, std::span<float> values)> values;
};

/// How many threads images may be read and written with, OpenEXR's among them; else as many as the machine
/// runs at once. @param threads at least 1
void limit_image_threads(int threads);

/// Writes an image by the file's ending, XYZ as such only to .exr: .exr and .hdr as floats, .png and .jpg
/// sRGB-encoded after an exposure of `exposure_ev` stops. EXR and PNG hold the metadata (PNG as text chunks),
/// HDR and JPEG have no place for it. EXR alone holds the layers, and says what the image is a window of.
/// Written to a temporary name first: a failure leaves no half file.
/// @throws InputError when the ending is not known or the file cannot be written
void write_image(const std::filesystem::path& file, const Image& image, const Metadata& metadata = {},
                 double exposure_ev = 0.0, const std::vector<ImageLayer>& layers = {});

/// Writes one channel of floats, row by row from the top, to an .exr, as write_image does.
/// @throws InputError when the file cannot be written
void write_channel(const std::filesystem::path& file, const std::string& channel, const ImageShape& shape,
                   std::span<const float> values, const Metadata& metadata);

/// What write_image was given as metadata, other texts with it; nothing where there is no such image.
Metadata read_metadata(const std::filesystem::path& file);

/// Reads an image as linear sRGB, from the channels that find_color_channels finds; 8-bit files are
/// sRGB-decoded. Alpha is left out: colours are those that the file holds. Of an EXR the image is the data
/// window, and knows where in the display window it lies.
/// @throws InputError when there is no such file or it may not be read, it is no image, it has other
/// channels, or it is absurdly large
Image read_image(const std::filesystem::path& file);

/// The shape that read_image would give it; pixels are not read.
/// @throws InputError as read_image does
ImageShape read_image_shape(const std::filesystem::path& file);

/// Checks before a long render that `file` can be written: its folder exists and its ending is known.
/// @throws InputError
void check_writable_image(const std::filesystem::path& file);

/// Checks before a long render that a file of this ending can hold so many pixels.
/// @throws InputError
void check_image_size(const std::filesystem::path& file, int width, int height);

/// Whether the ending is one that write_image knows.
bool is_image(const std::filesystem::path& file);

/// Whether the ending is .exr in either case: alone it names its channels, and so may hold XYZ and layers.
bool is_exr(const std::filesystem::path& file);

/// Whether the ending, .exr or .hdr in either case, is that of an image of floats.
bool is_float_image(const std::filesystem::path& file);

}  // namespace photopic
