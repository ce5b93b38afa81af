#include "density_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "optimize/path_estimate.h"
#include "spectrum_plot.h"
#include "svg_plot.h"

namespace photopic {
namespace {

constexpr double kWidth = 900.0, kHeight = 830.0;
constexpr double kBin = 1.0;  ///< [nm]: a density is drawn as its mean over each, lines and all

/// p_k in bins: differences of its CDF, Q_k(B(λ)). Points (nm, 1/nm).
std::vector<PlotPoint> binned_density(const PiecewiseLinearDensity& base, const PiecewiseLinearDensity& q) {
  std::vector<PlotPoint> points;
  double before = 0.0;
  for (double nm = kLambdaMin; nm < kLambdaMax; nm += kBin) {
    const double until = q.cdf(base.cdf(nm + kBin));
    points.push_back({nm + 0.5 * kBin, std::max(0.0, until - before) / kBin});
    before = until;
  }
  return points;
}

double highest(std::span<const PlotPoint> points) {
  double top = 0.0;
  for (const PlotPoint& p : points) top = std::max(top, p.y);
  return top;
}

void draw_legend(SvgDrawing& svg, const WavelengthDistribution& distribution) {
  const int count = static_cast<int>(distribution.components.size());
  const int columns = std::min(count, 8);
  const double step = 790.0 / 8.0;
  for (int k = 0; k < count; ++k) {
    const double x = 80.0 + step * (k % columns), y = 76.0 + 18.0 * (k / columns);
    svg.line({x, y - 4.0}, {x + 24.0, y - 4.0}, line_color(k), 2.4, line_dashes(k));
    const bool backwards = distribution.components[static_cast<std::size_t>(k)].backwards;
    svg.text({x + 30.0, y}, fmt::format("p{} of {}", k + 1, backwards ? "1−u" : "u"), {.size = 12.0});
  }
}

void draw_densities(SvgDrawing& svg, const WavelengthDistribution& distribution,
                    const TabulatedSpectrum& light) {
  std::vector<std::vector<PlotPoint>> densities;
  double top = 0.0;
  for (const PiecewiseLinearDensity& q : densities_on_t(distribution)) {
    densities.push_back(binned_density(distribution.base, q));
    top = std::max(top, highest(densities.back()));
  }
  const PlotFrame frame({.left = 80, .top = 112, .width = 790, .height = 330},
                        {kLambdaMin, kLambdaMax, "wavelength [nm]"}, {0.0, 1.05 * top, "density [1/nm]"});
  frame.draw_grid(svg);
  draw_spectrum_area(svg, frame, plotted_spectrum(light), top, 0.3);
  for (std::size_t k = 0; k < densities.size(); ++k) {
    const int index = static_cast<int>(k);
    svg.curve(frame.map(densities[k]), line_color(index), 1.8, line_dashes(index));
  }
}

constexpr int kEstimates = 800;  ///< points of a curve over u
constexpr std::array<std::string_view, 3> kNames{"X", "Y", "Z"};
constexpr std::array<int, 3> kColors{1, 2, 0};  ///< vermilion, green, blue

/// X, Y, Z of one path, as three curves over u, and what they ought to be.
struct Estimates {
  std::array<std::vector<PlotPoint>, 3> curves;
  std::array<double, 3> expected;
};

Estimates estimates_over_u(const WavelengthDistribution& distribution, const TabulatedSpectrum& light) {
  const WavelengthSampler sampler = OptimizedWavelengths(distribution);
  PathEstimate path(sampler, light);
  const Xyz mean = path.expected(ConstantSpectrum{1.0});
  Estimates estimates{.curves = {}, .expected = {mean.x, mean.y, mean.z}};
  for (int i = 0; i < kEstimates; ++i) {
    const double u = (i + 0.5) / kEstimates;
    path.draw(u);
    const Xyz e = path.white();
    estimates.curves[0].push_back({u, e.x});
    estimates.curves[1].push_back({u, e.y});
    estimates.curves[2].push_back({u, e.z});
  }
  return estimates;
}

double highest(const Estimates& estimates) {
  double top = *std::max_element(estimates.expected.begin(), estimates.expected.end());
  for (const auto& curve : estimates.curves) top = std::max(top, highest(curve));
  return top;
}

void draw_estimates(SvgDrawing& svg, const PlotBox& box, const Estimates& estimates, double top,
                    const std::string& title, const std::string& y_label) {
  const PlotFrame frame(box, {0.0, 1.0, "u"}, {0.0, top, y_label});
  frame.draw_grid(svg);
  svg.text({box.left, box.top - 14.0}, title, {.size = 14.0, .color = "#111111", .bold = true});
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string_view color = line_color(kColors[c]);
    const double mean = estimates.expected[c];
    svg.line(frame.map({0.0, mean}), frame.map({1.0, mean}), color, 1.2, "2 4");
    svg.curve(frame.map(estimates.curves[c]), color, 1.6);
    const double x = box.right() - 112.0 + 40.0 * static_cast<double>(c);
    svg.line({x, box.top - 18.0}, {x + 16.0, box.top - 18.0}, color, 2.4);
    svg.text({x + 20.0, box.top - 14.0}, kNames[c], {.size = 12.0});
  }
}

}  // namespace

std::string density_plot(const WavelengthDistribution& initial, const WavelengthDistribution& optimized,
                         const TabulatedSpectrum& light) {
  SvgDrawing svg(kWidth, kHeight);
  svg.text({80, 34}, optimized.spectrum, {.size = 18.0, .color = "#111111", .bold = true});
  svg.text({870, 34},
           fmt::format("{} wavelengths a path; {} ΔE {:.2f}, uniform {:.2f}", optimized.components.size(),
                       optimized.objective, optimized.value, optimized.uniform_value),
           {.size = 13.0, .anchor = SvgDrawing::Anchor::end, .color = "#555555"});
  draw_legend(svg, optimized);
  draw_densities(svg, optimized, light);

  const Estimates before = estimates_over_u(initial, light), after = estimates_over_u(optimized, light);
  const double top = 1.05 * std::max(highest(before), highest(after));
  draw_estimates(svg, {.left = 80, .top = 545, .width = 370, .height = 225}, before, top,
                 "One path, equal strata", "estimate (Y of white is 1)");
  draw_estimates(svg, {.left = 500, .top = 545, .width = 370, .height = 225}, after, top,
                 "One path, optimised", "");
  return svg.text_of_file();
}

}  // namespace photopic
