#include "image_pair.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "messages.h"

namespace photopic {
namespace {

constexpr std::size_t kMostOfAValue = 60;  // characters; the spectra of many lamps are a long list

bool same_window(const ImageShape& a, const ImageShape& b) {
  return a.left == b.left && a.top == b.top && a.full_width == b.full_width && a.full_height == b.full_height;
}

std::string shortened(const std::string& value) {
  return value.size() <= kMostOfAValue ? value : value.substr(0, kMostOfAValue) + "…";
}

}  // namespace

std::string window_text(const ImageShape& image) {
  return fmt::format("{},{},{},{}", image.left, image.top, image.left + image.width,
                     image.top + image.height);
}

std::optional<Image> matching_part(const ImageShape& part, const Image& whole) {
  const bool inside = part.left >= 0 && part.top >= 0 && part.left + part.width <= part.full_width &&
                      part.top + part.height <= part.full_height;
  if (part.is_whole() || !whole.is_whole() || !inside || whole.width != part.full_width ||
      whole.height != part.full_height)
    return std::nullopt;
  Image matching(part.width, part.height, whole.space);
  static_cast<ImageShape&>(matching) = part;
  for (int y = 0; y < part.height; ++y)
    std::copy_n(whole.at(part.left, part.top + y), 3 * static_cast<std::size_t>(part.width),
                matching.at(0, y));
  return matching;
}

void check_same_pixels(const ImageShape& reference, const ImageShape& image, const std::string& name) {
  if (image.width != reference.width || image.height != reference.height)
    throw InputError(name,
                     fmt::format("is {}x{} pixels, not {}x{}", image.width, image.height, reference.width,
                                 reference.height),
                     "give images of one size");
  if (reference.full_width > 0 && image.full_width > 0 && !same_window(reference, image))
    throw InputError(
        name,
        fmt::format("is the window {} of {}x{} pixels, not {} of {}x{}", window_text(image), image.full_width,
                    image.full_height, window_text(reference), reference.full_width, reference.full_height),
        "give images of one window");
}

void warn_of_shared_noise(const Metadata& reference, const std::string& name, const Metadata& image) {
  const auto shares = [&](const char* key) {
    const auto a = reference.find(key), b = image.find(key);
    return a != reference.end() && b != image.end() && a->second == b->second;
  };
  if (shares("seed") && shares("sampler"))
    print_warning(fmt::format(
        "{}: has the reference's sampler and seed ({}), and with them its noise: its error comes out too "
        "small; render one with another --seed",
        name, reference.at("seed")));
}

void warn_of_other_light(const Metadata& reference, const std::string& name, const Metadata& image) {
  std::string differences;
  for (const auto& [key, called] :
       {std::pair{"spectra", "spectra"}, {"observer", "observer"}, {"white_balance", "white balance"}}) {
    const auto a = reference.find(key), b = image.find(key);
    if (a == reference.end() || b == image.end() || a->second == b->second) continue;
    differences += fmt::format("{}{} {}, not {}", differences.empty() ? "" : "; ", called,
                               shortened(b->second), shortened(a->second));
  }
  if (!differences.empty())
    print_warning(
        fmt::format("{}: cannot match the reference, by what both files tell: {}", name, differences));
}

void warn_of_8_bit_reference(const std::filesystem::path& file) {
  if (is_image(file) && !is_float_image(file))
    print_warning(
        file.string() +
        ": the reference's colours are clipped to [0, 1] and rounded to 8 bits, which counts as error; "
        "an .exr holds them whole");
}

}  // namespace photopic
