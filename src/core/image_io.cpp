#include "core/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>

#include "atomic_file.h"
#include "core/image_channels.h"
#include "core/memory_file.h"
#include "core/quiet_stderr.h"
#include "error.h"
#include "file_ending.h"
#include "input_file.h"
#include "spectral/color.h"

namespace photopic {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
constexpr int kMaxJpegSide = 65500;  // libjpeg's JPEG_MAX_DIMENSION; beyond it the library ends the process

enum class Encoding { unknown, linear, srgb };

Encoding encoding_of(const std::filesystem::path& file) {
  const std::string ending = lower_case_ending(file);
  if (ending == ".exr" || ending == ".hdr") return Encoding::linear;
  if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") return Encoding::srgb;
  return Encoding::unknown;
}

void check_ending(const std::filesystem::path& file) {
  if (encoding_of(file) == Encoding::unknown)
    throw InputError(file.string(), "the ending is not one of .exr, .hdr, .png, .jpg", "name the image so");
}

std::string reason(const std::string& text) {
  return text.empty() ? "unknown reason" : without_controls(text);
}

/// 8-bit sRGB after exposure. A pixel with a NaN is magenta, so that it is seen.
std::vector<std::uint8_t> encode(const Image& image, double exposure_ev) {
  const double scale = std::exp2(exposure_ev);
  std::vector<std::uint8_t> bytes(image.pixels.size());
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    const float* pixel = &image.pixels[i];
    const bool nan = std::isnan(pixel[0]) || std::isnan(pixel[1]) || std::isnan(pixel[2]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = nan ? (c == 1 ? 0.0 : 1.0) : srgb_encode(std::clamp(pixel[c] * scale, 0.0, 1.0));
      bytes[i + c] = static_cast<std::uint8_t>(std::lround(255.0 * value));
    }
  }
  return bytes;
}

/// The eight numbers of OpenEXR's attribute: x and y of red, green, blue and white.
using Chromaticities = std::array<float, 8>;
/// Rec. ITU-R BT.709-6, table 1, white D65.
constexpr Chromaticities kRec709 = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
constexpr Chromaticities kXyz = {1, 0, 0, 1, 0, 0, 1.0f / 3.0f, 1.0f / 3.0f};

/// OpenEXR's data window in its display window.
void set_windows(const ImageShape& image, OIIO::ImageSpec& spec) {
  if (image.full_width == 0) return;
  spec.x = image.left, spec.y = image.top;
  spec.full_x = spec.full_y = 0;
  spec.full_width = image.full_width, spec.full_height = image.full_height;
}

Image to_linear_srgb(const Image& xyz) {
  Image image(xyz.width, xyz.height);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    const Rgb rgb = xyz_to_linear_srgb({xyz.pixels[i], xyz.pixels[i + 1], xyz.pixels[i + 2]});
    image.pixels[i] = static_cast<float>(rgb.r);
    image.pixels[i + 1] = static_cast<float>(rgb.g);
    image.pixels[i + 2] = static_cast<float>(rgb.b);
  }
  return image;
}

/// Rows that EXR's zip compresses together.
constexpr int kRowsAtOnce = 16;

OIIO::ImageSpec make_spec(const Image& image, bool linear, const Metadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, 3, linear ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
  if (linear) {
    const bool xyz = image.space == ColorSpace::xyz;
    if (xyz) spec.channelnames = {"X", "Y", "Z"};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), (xyz ? kXyz : kRec709).data());
    spec.attribute("compression", "zip");
  } else {
    spec.attribute("CompressionQuality", 95);
  }
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  return spec;
}

void add_layers(OIIO::ImageSpec& spec, const std::vector<ImageLayer>& layers) {
  for (const ImageLayer& layer : layers) {
    spec.channelnames.insert(spec.channelnames.end(), layer.channels.begin(), layer.channels.end());
    for (const auto& [key, value] : layer.metadata) spec.attribute(key, value);
  }
  spec.nchannels = static_cast<int>(spec.channelnames.size());
}

/// A few rows at a time: hundreds of channels need no second copy.
bool write_rows(OIIO::ImageOutput& output, const Image& image, const std::vector<ImageLayer>& layers) {
  const auto channels = static_cast<std::size_t>(output.spec().nchannels);
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<float> rows(kRowsAtOnce * width * channels);
  for (int y = 0; y < image.height; y += kRowsAtOnce) {
    const int end = std::min(y + kRowsAtOnce, image.height);
    float* values = rows.data();
    for (std::size_t i = static_cast<std::size_t>(y) * width; i < static_cast<std::size_t>(end) * width;
         ++i) {
      values = std::copy_n(&image.pixels[3 * i], 3, values);
      for (const ImageLayer& layer : layers) {
        layer.values(i, {values, layer.channels.size()});
        values += layer.channels.size();
      }
    }
    const int top = output.spec().y;
    if (!output.write_scanlines(top + y, top + end, 0, OIIO::TypeDesc::FLOAT, rows.data())) return false;
  }
  return true;
}

using WritePixels = std::function<bool(OIIO::ImageOutput& output)>;

/// The file's bytes. They go to memory, since of the libraries that would write them libpng does not tell of
/// a full disk, and libjpeg ends the process.
/// @param file its ending is the format, its name is for messages
void encode_file(const std::filesystem::path& file, const OIIO::ImageSpec& spec,
                 const WritePixels& write_pixels, MemoryFile& memory) {
  const auto fail = [&](const std::string& why) {
    if (why.find("std::bad_alloc") != why.npos) throw std::bad_alloc();  // OpenEXR's, become a text
    throw InputError(file.string(), "cannot be written: " + reason(why),
                     "choose another kind of file or a smaller resolution");
  };
  const QuietStderr quiet;  // libpng's errors are told below
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.string());
  if (!output) fail(OIIO::geterror());
  OIIO::Filesystem::IOFile stream(memory.stream(), OIIO::Filesystem::IOProxy::Write);
  if (!output->set_ioproxy(&stream)) fail("it cannot be made in memory");
  if (!output->open(file.string(), spec)) fail(output->geterror());
  if (!write_pixels(*output) || !output->close()) fail(output->geterror());
}

void write_encoded(const std::filesystem::path& file, const OIIO::ImageSpec& spec,
                   const WritePixels& write_pixels) {
  try {
    MemoryFile memory;
    encode_file(file, spec, write_pixels, memory);
    write_file(file, memory.bytes());
  } catch (const std::bad_alloc&) {
    throw InputError(file.string(), "cannot be written: out of memory, where the file is put together",
                     "choose a smaller resolution or fewer layers");
  }
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& problem,
                         const std::string& remedy) {
  throw InputError(file.string(), problem, remedy);
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file) {
  check_readable_file(file);
  OIIO::ImageSpec colors_as_stored;  // else what is not associated would be multiplied while still encoded
  colors_as_stored["oiio:UnassociatedAlpha"] = 1;
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string(), &colors_as_stored);
  const std::string why = OIIO::geterror();
  if (!input)
    refuse(file, "this is no image that can be read" + (is_image(file) ? ": " + reason(why) : ""),
           "give an .exr, .hdr, .png or .jpg");
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 ||
      std::int64_t{spec.width} * spec.height > kMaxPixels) {
    refuse(file, fmt::format("{} x {} x {} pixels cannot be read", spec.width, spec.height, spec.depth),
           "give a smaller picture");
  }
  return input;
}

/// OpenEXR's data window in its display window; other formats do not tell of windows, or tell nothing by
/// them.
ImageShape shape_of(const OIIO::ImageInput& input) {
  const OIIO::ImageSpec& spec = input.spec();
  if (std::string_view(input.format_name()) != "openexr") return {spec.width, spec.height};
  return {spec.width,           spec.height,     spec.x - spec.full_x,
          spec.y - spec.full_y, spec.full_width, spec.full_height};
}

ColorChannels color_channels(const std::filesystem::path& file, const OIIO::ImageSpec& spec) {
  if (const auto channels = find_color_channels(spec.channelnames)) return *channels;
  refuse(file, "its channels are not those of one picture: " + list_channels(spec.channelnames),
         "give R, G, B or X, Y, Z, of one layer, or a grey Y");
}

/// At once where they stand side by side.
bool read_channels(OIIO::ImageInput& input, const ColorChannels& channels, Image& image) {
  const auto read = [&](std::size_t first, int count, float* values) {
    const int begin = static_cast<int>(first);
    return input.read_image(0, 0, begin, begin + count, OIIO::TypeDesc::FLOAT, values, 3 * sizeof(float));
  };
  const auto [a, b, c] = channels.index;
  if (b == a + 1 && c == b + 1) return read(a, 3, image.pixels.data());
  return read(a, 1, &image.pixels[0]) && read(b, 1, &image.pixels[1]) && read(c, 1, &image.pixels[2]);
}

}  // namespace

bool is_image(const std::filesystem::path& file) {
  return encoding_of(file) != Encoding::unknown;
}

void check_writable_image(const std::filesystem::path& file) {
  check_ending(file);
  check_writable_file(file);
}

void check_image_size(const std::filesystem::path& file, int width, int height) {
  const std::string ending = lower_case_ending(file);
  if ((ending != ".jpg" && ending != ".jpeg") || std::max(width, height) <= kMaxJpegSide) return;
  throw InputError(
      file.string(),
      fmt::format("a JPEG holds at most {} pixels a side, not {}x{}", kMaxJpegSide, width, height),
      "choose a smaller --resolution, or .png");
}

bool is_float_image(const std::filesystem::path& file) {
  return encoding_of(file) == Encoding::linear;
}

bool is_exr(const std::filesystem::path& file) {
  return lower_case_ending(file) == ".exr";
}

void limit_image_threads(int threads) {
  OIIO::attribute("threads", threads);
  OIIO::attribute("exr_threads", threads > 1 ? threads : -1);  // beside the caller, who waits; -1: none
}

void write_image(const std::filesystem::path& file, const Image& image, const Metadata& metadata,
                 double exposure_ev, const std::vector<ImageLayer>& layers) {
  check_ending(file);
  check_image_size(file, image.width, image.height);
  const bool exr = is_exr(file), linear = is_float_image(file);
  if (image.space == ColorSpace::xyz && !exr)
    return write_image(file, to_linear_srgb(image), metadata, exposure_ev);
  OIIO::ImageSpec spec = make_spec(image, linear, metadata);
  if (exr) set_windows(image, spec);
  if (exr) add_layers(spec, layers);
  write_encoded(file, spec, [&](OIIO::ImageOutput& output) {
    if (exr && !layers.empty()) return write_rows(output, image, layers);
    if (linear) return output.write_image(OIIO::TypeDesc::FLOAT, image.pixels.data());
    return output.write_image(OIIO::TypeDesc::UINT8, encode(image, exposure_ev).data());
  });
}

void write_channel(const std::filesystem::path& file, const std::string& channel, const ImageShape& shape,
                   std::span<const float> values, const Metadata& metadata) {
  OIIO::ImageSpec spec(shape.width, shape.height, 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {channel};
  spec.attribute("compression", "zip");
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  set_windows(shape, spec);
  write_encoded(file, spec, [&](OIIO::ImageOutput& output) {
    return output.write_image(OIIO::TypeDesc::FLOAT, values.data());
  });
}

Metadata read_metadata(const std::filesystem::path& file) {
  const QuietStderr quiet;
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
  static_cast<void>(OIIO::geterror());
  Metadata metadata;
  if (!input) return metadata;
  for (const OIIO::ParamValue& attribute : input->spec().extra_attribs)
    if (attribute.type() == OIIO::TypeString) metadata[attribute.name().string()] = attribute.get_string();
  return metadata;
}

Image read_image(const std::filesystem::path& file) {
  const QuietStderr quiet;
  const std::unique_ptr<OIIO::ImageInput> input = open_image(file);
  const ColorChannels channels = color_channels(file, input->spec());
  Image image(input->spec().width, input->spec().height);
  if (!read_channels(*input, channels, image))
    refuse(file, "it is damaged: " + reason(input->geterror()), "copy or write it again");
  if (!input->spec().format.is_floating_point()) {
    for (float& value : image.pixels) value = static_cast<float>(srgb_decode(value));
  }
  if (channels.space == ColorSpace::xyz) image = to_linear_srgb(image);
  static_cast<ImageShape&>(image) = shape_of(*input);
  return image;
}

ImageShape read_image_shape(const std::filesystem::path& file) {
  const QuietStderr quiet;
  return shape_of(*open_image(file));
}

}  // namespace photopic
