#include "crop.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <utility>

#include "error.h"

namespace photopic {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw InputError("--crop " + text, "is no window of pixels",
                   "write it as X0,Y0,X1,Y1, as 100,50,200,150: from the top left, X1 and Y1 just outside");
}

}  // namespace

std::optional<PixelWindow> parse_crop(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::array<int, 4> sides{};
  const char *at = text.data(), *end = at + text.size();
  for (int& side : sides) {
    if (&side != sides.data() && (at == end || *at++ != ',')) refuse(text);
    const auto [rest, error] = std::from_chars(at, end, side);
    if (error != std::errc()) refuse(text);
    at = rest;
  }
  const auto [x0, y0, x1, y1] = sides;
  if (at != end || x0 < 0 || y0 < 0 || x1 <= x0 || y1 <= y0) refuse(text);
  return PixelWindow{x0, y0, x1, y1};
}

void check_crop(const PixelWindow& window, const Camera& camera) {
  if (window.x1 <= camera.width && window.y1 <= camera.height) return;
  throw InputError(fmt::format("--crop {},{},{},{}", window.x0, window.y0, window.x1, window.y1),
                   fmt::format("reaches beyond the picture of {}x{}", camera.width, camera.height),
                   "give a window inside it, or a larger --resolution");
}

nlohmann::ordered_json crop_json(const std::optional<PixelWindow>& window) {
  if (!window) return {};
  return {window->x0, window->y0, window->x1, window->y1};
}

void crop_layers(const PixelWindow& window, const Camera& camera, std::vector<ImageLayer>& layers) {
  for (ImageLayer& layer : layers)
    layer.values = [whole = std::move(layer.values), window, width = camera.width](std::size_t pixel,
                                                                                   std::span<float> values) {
      whole(window.pixel_of_image(pixel, width), values);
    };
}

void place_in(const PixelWindow& window, const Camera& camera, Image& image) {
  image.left = window.x0, image.top = window.y0;
  image.full_width = camera.width, image.full_height = camera.height;
}

}  // namespace photopic
