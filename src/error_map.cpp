#include "error_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "error.h"
#include "file_ending.h"

namespace photopic {
namespace {

/// The inverse of CIELAB's f (CIE 15:2018, 8.2.1).
double cube_of(double f) {
  constexpr double kDelta = 6.0 / 29.0;
  return f > kDelta ? f * f * f : 3.0 * kDelta * kDelta * (f - 4.0 / 29.0);
}

Rgb lab_to_linear_srgb(const Lab& lab) {
  const Xyz white = d65_white();
  const double y = (lab.l + 16.0) / 116.0;
  return xyz_to_linear_srgb(
      {white.x * cube_of(y + lab.a / 500.0), white.y * cube_of(y), white.z * cube_of(y - lab.b / 200.0)});
}

Image paint(const ImageShape& shape, const std::vector<double>& delta_e) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Image picture(shape.width, shape.height);
  for (std::size_t i = 0; i < delta_e.size(); ++i) {
    const Rgb color = std::isnan(delta_e[i]) ? Rgb{kNan, kNan, kNan} : error_color(delta_e[i]);
    picture.set(i, color.r, color.g, color.b);
  }
  return picture;
}

}  // namespace

Rgb error_color(double delta_e) {
  // As saturated as sRGB's gamut allows for all of the way.
  constexpr double kFirstHue = 300.0, kLastHue = 460.0, kChroma = 65.0;
  const double t = std::clamp(delta_e / kBrightestDeltaE, 0.0, 1.0);
  const double hue = std::lerp(kFirstHue, kLastHue, t) * std::numbers::pi / 180.0;
  const double chroma = kChroma * 4.0 * t * (1.0 - t);
  return lab_to_linear_srgb({100.0 * t, chroma * std::cos(hue), chroma * std::sin(hue)});
}

void check_writable_map(const std::filesystem::path& file) {
  if (!is_exr(file) && lower_case_ending(file) != ".png")
    throw InputError(file.string(), "the ending is not .exr or .png", "name the map so");
  check_writable_image(file);
}

void write_error_map(const std::filesystem::path& file, const ImageShape& shape,
                     const std::vector<double>& delta_e, const Metadata& metadata) {
  if (is_exr(file))
    return write_channel(file, "dE", shape, std::vector<float>(delta_e.begin(), delta_e.end()), metadata);
  Metadata scaled = metadata;
  scaled["scale"] = fmt::format("black to white: CIEDE2000 of 0 to {}", kBrightestDeltaE);
  write_image(file, paint(shape, delta_e), scaled);
}

}  // namespace photopic
