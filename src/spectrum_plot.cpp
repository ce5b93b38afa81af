#include "spectrum_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spectral/observer.h"

namespace photopic {
namespace {

/// The colour of one wavelength, lightened until it lies within sRGB, dimmed towards the ends of the range.
std::string wavelength_color(double nm) {
  const Xyz h = Observer::cie1931()(nm);
  Rgb c = xyz_to_linear_srgb(h);
  const double lift = std::max(0.0, -std::min({c.r, c.g, c.b}));
  c = {c.r + lift, c.g + lift, c.b + lift};
  const double largest = std::max({c.r, c.g, c.b, 1e-9}), sum = h.x + h.y + h.z;
  const double strength = sum / (sum + 0.05);
  const auto byte = [&](double v) {
    const double light = 0.45 * (1.0 - strength) + strength * v / largest;
    return static_cast<int>(std::lround(255.0 * srgb_encode(std::clamp(light, 0.0, 1.0))));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}

constexpr double kColorStep = 5.0;  ///< [nm]

std::vector<std::string> wavelength_colors() {
  std::vector<std::string> colors;
  for (double nm = kLambdaMin; nm <= kLambdaMax; nm += kColorStep) colors.push_back(wavelength_color(nm));
  return colors;
}

/// Names lines, the most luminous first, where their names do not run into each other.
void name_lines(SvgDrawing& svg, const PlotFrame& frame, std::span<const PlotPoint> spectrum,
                std::vector<EmissionLine> lines) {
  std::sort(lines.begin(), lines.end(), [](const EmissionLine& a, const EmissionLine& b) {
    return a.luminance_share > b.luminance_share;
  });
  std::vector<double> taken;
  for (const EmissionLine& line : lines) {
    const double x = frame.map({line.wavelength, 0.0}).x;
    if (std::any_of(taken.begin(), taken.end(), [x](double other) { return std::abs(other - x) < 40.0; }))
      continue;
    taken.push_back(x);
    double top = 0.0;
    for (const PlotPoint& p : spectrum)
      if (std::abs(p.x - line.wavelength) <= 2.0) top = std::max(top, p.y);
    svg.text({x, frame.map({0.0, top}).y - 6.0}, fmt::format("{:.1f}", line.wavelength),
             {.size = 11.0, .anchor = SvgDrawing::Anchor::middle});
  }
}

}  // namespace

std::vector<PlotPoint> plotted_spectrum(const TabulatedSpectrum& emission) {
  const auto x = emission.lambda(), y = emission.value();
  std::vector<double> bins(static_cast<std::size_t>(kLambdaMax - kLambdaMin), 0.0);
  const double largest = *std::max_element(y.begin(), y.end());
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double width = x[i + 1] - x[i];
    const auto value = [&](double nm) {
      return (y[i] + (y[i + 1] - y[i]) * ((nm - x[i]) / width)) / largest;
    };
    for (double from = x[i]; from < x[i + 1];) {
      const double to = std::min(std::floor(from) + 1.0, x[i + 1]);
      const auto bin = static_cast<std::size_t>(std::floor(from) - kLambdaMin);
      if (bin < bins.size()) bins[bin] += 0.5 * (to - from) * (value(from) + value(to));
      from = to;
    }
  }
  const double top = *std::max_element(bins.begin(), bins.end());
  std::vector<PlotPoint> points;
  for (std::size_t i = 0; i < bins.size(); ++i)
    points.push_back({kLambdaMin + static_cast<double>(i) + 0.5, top > 0.0 ? bins[i] / top : 0.0});
  return points;
}

void draw_spectrum_area(SvgDrawing& svg, const PlotFrame& frame, std::span<const PlotPoint> spectrum,
                        double height, double opacity) {
  std::vector<PlotPoint> outline{frame.map({kLambdaMin, 0.0})};
  for (const PlotPoint& p : spectrum) outline.push_back(frame.map({p.x, height * p.y}));
  outline.push_back(frame.map({kLambdaMax, 0.0}));
  svg.area(outline, svg.gradient(frame.box().left, frame.box().right(), wavelength_colors()), opacity);
  svg.curve(std::span(outline).subspan(1, spectrum.size()), "#777777", 0.8);
}

std::string spectrum_plot(const TabulatedSpectrum& emission, const LampDescription& lamp,
                          const std::string& title, const std::string& subtitle) {
  SvgDrawing svg(900, 460);
  const PlotFrame frame({.left = 80, .top = 80, .width = 790, .height = 320},
                        {kLambdaMin, kLambdaMax, "wavelength [nm]"}, {0.0, 1.08, "relative power"});
  svg.text({80, 32}, title, {.size = 18.0, .color = "#111111", .bold = true});
  svg.text({80, 54}, subtitle, {.size = 13.0, .color = "#555555"});
  frame.draw_grid(svg);
  const std::vector<PlotPoint> spectrum = plotted_spectrum(emission);
  draw_spectrum_area(svg, frame, spectrum, 1.0, 0.85);
  name_lines(svg, frame, spectrum, lamp.lines);
  return svg.text_of_file();
}

}  // namespace photopic
