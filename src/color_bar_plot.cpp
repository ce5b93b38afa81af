#include "color_bar_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "optimize/color_bar.h"
#include "svg_plot.h"

namespace photopic {
namespace {

constexpr double kLeft = 110.0, kWidth = 760.0, kTop = 56.0, kBar = 56.0, kGap = 10.0;
constexpr int kColors = 760;  ///< of a bar: one a pixel

std::string hex_color(const Rgb& c) {
  const auto byte = [](double v) {
    return static_cast<int>(std::lround(255.0 * srgb_encode(std::clamp(v, 0.0, 1.0))));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}

void draw_bar(SvgDrawing& svg, double top, std::string_view name, std::span<const Rgb> pixels) {
  std::vector<std::string> colors;
  for (const Rgb& pixel : pixels) colors.push_back(hex_color(pixel));
  const std::array<PlotPoint, 4> outline{
      PlotPoint{kLeft, top}, {kLeft + kWidth, top}, {kLeft + kWidth, top + kBar}, {kLeft, top + kBar}};
  svg.area(outline, svg.gradient(kLeft, kLeft + kWidth, colors), 1.0);
  svg.text({kLeft - 12.0, top + 0.5 * kBar + 4.0}, name, {.size = 13.0, .anchor = SvgDrawing::Anchor::end});
}

void draw_axis(SvgDrawing& svg, double y) {
  svg.line({kLeft, y}, {kLeft + kWidth, y}, "#888888", 1.0);
  for (const double u : plot_ticks(0.0, 1.0, 10)) {
    const double x = kLeft + kWidth * u;
    svg.line({x, y}, {x, y + 5.0}, "#888888", 1.0);
    svg.text({x, y + 19.0}, fmt::format("{:.1f}", u), {.anchor = SvgDrawing::Anchor::middle});
  }
  svg.text({kLeft + 0.5 * kWidth, y + 38.0}, "u, the one random number that chooses a path's wavelengths",
           {.size = 13.0, .anchor = SvgDrawing::Anchor::middle});
}

}  // namespace

std::string color_bar_plot(const std::string& title, std::span<const WavelengthSampler> samplers,
                           const TabulatedSpectrum& emission) {
  const ColorBar bar = color_bar(samplers, emission, kColors, 1);
  const double bottom = kTop + (kBar + kGap) * bar.height;
  SvgDrawing svg(kLeft + kWidth + 30.0, bottom + 50.0);
  svg.text({kLeft, 32.0}, title, {.size = 16.0, .color = "#111111", .bold = true});
  svg.text({kLeft + kWidth, 32.0}, "a white surface as a single path sees it",
           {.size = 13.0, .anchor = SvgDrawing::Anchor::end, .color = "#555555"});
  for (int row = 0; row < bar.height; ++row) {
    const std::span<const Rgb> pixels(&bar.pixels[static_cast<std::size_t>(row) * kColors], kColors);
    const auto sampler = static_cast<std::size_t>(row);
    draw_bar(svg, kTop + (kBar + kGap) * row,
             sampler < samplers.size() ? sampler_name(samplers[sampler]) : "true colour", pixels);
  }
  draw_axis(svg, bottom);
  return svg.text_of_file();
}

}  // namespace photopic
