#include "svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace photopic {
namespace {

constexpr std::string_view kGrid = "#e3e3e3", kFrame = "#888888";

std::string_view anchor_name(SvgDrawing::Anchor anchor) {
  if (anchor == SvgDrawing::Anchor::middle) return "middle";
  return anchor == SvgDrawing::Anchor::end ? "end" : "start";
}

/// How many bytes of UTF-8 the first character has; 0 when it is none.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  return length;
}

/// What XML does not allow, in a file's name for instance, becomes a question mark.
std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(1, length));
    const char first = character[0];
    if (first == '&') {
      result += "&amp;";
    } else if (first == '<') {
      result += "&lt;";
    } else if (first == '>') {
      result += "&gt;";
    } else if (first == '"') {
      result += "&quot;";
    } else if (length == 0 || (length == 1 && (first < ' ' || first == 0x7f))) {
      result += '?';
    } else {
      result += character;
    }
    text.remove_prefix(character.size());
  }
  return result;
}

std::string coordinates(std::span<const PlotPoint> points) {
  std::string text;
  for (const PlotPoint& p : points) fmt::format_to(std::back_inserter(text), "{:.2f},{:.2f} ", p.x, p.y);
  if (!text.empty()) text.pop_back();
  return text;
}

std::string dash_attribute(std::string_view dashes) {
  return dashes.empty() ? std::string() : fmt::format(" stroke-dasharray=\"{}\"", dashes);
}

std::string tick_label(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  if (decimals > 5 || step >= 1e6) return fmt::format("{:g}", value);
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

SvgDrawing::SvgDrawing(double width, double height) : width_(width), height_(height) {}

void SvgDrawing::text(PlotPoint at, std::string_view content, const TextStyle& style) {
  const std::string turn =
      style.upright ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", at.x, at.y) : std::string();
  body_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:g}\" text-anchor=\"{}\" fill=\"{}\"{}{}>{}</text>\n",
      at.x, at.y, style.size, anchor_name(style.anchor), style.color,
      style.bold ? " font-weight=\"bold\"" : "", turn, escaped(content));
}

void SvgDrawing::line(PlotPoint from, PlotPoint to, std::string_view color, double width,
                      std::string_view dashes) {
  body_ += fmt::format(
      "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
      "stroke-width=\"{:g}\"{}/>\n",
      from.x, from.y, to.x, to.y, color, width, dash_attribute(dashes));
}

void SvgDrawing::curve(std::span<const PlotPoint> points, std::string_view color, double width,
                       std::string_view dashes) {
  body_ += fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" "
      "stroke-linejoin=\"round\"{}/>\n",
      coordinates(points), color, width, dash_attribute(dashes));
}

void SvgDrawing::area(std::span<const PlotPoint> outline, std::string_view fill, double opacity) {
  body_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"{:g}\"/>\n", coordinates(outline),
                       fill, opacity);
}

std::string SvgDrawing::gradient(double from, double to, std::span<const std::string> colors) {
  const std::string name = fmt::format("gradient{}", ++gradients_);
  body_ += fmt::format(
      "<linearGradient id=\"{}\" gradientUnits=\"userSpaceOnUse\" x1=\"{:.2f}\" y1=\"0\" x2=\"{:.2f}\" "
      "y2=\"0\">",
      name, from, to);
  for (std::size_t i = 0; i < colors.size(); ++i)
    body_ += fmt::format("<stop offset=\"{:.4f}\" stop-color=\"{}\"/>",
                         static_cast<double>(i) / static_cast<double>(colors.size() - 1), colors[i]);
  body_ += "</linearGradient>\n";
  return "url(#" + name + ")";
}

std::string SvgDrawing::text_of_file() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} "
      "{1:g}\" "
      "font-family=\"Helvetica, Arial, Liberation Sans, sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width_, height_, body_);
}

std::vector<double> plot_ticks(double first, double last, int about) {
  const double rough = (last - first) / about;
  if (!(rough > 0.0) || !std::isfinite(rough)) return {};
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (rough <= factor * power * (1.0 + 1e-9)) step = factor * power;
  std::vector<double> ticks;
  for (double i = std::ceil(first / step - 1e-9); i * step <= last + 1e-9 * step; i += 1.0)
    ticks.push_back(i == 0.0 ? 0.0 : i * step);
  return ticks;
}

PlotFrame::PlotFrame(const PlotBox& box, PlotAxis x, PlotAxis y)
    : box_(box), x_(std::move(x)), y_(std::move(y)) {}

PlotPoint PlotFrame::map(PlotPoint data) const {
  return {box_.left + box_.width * (data.x - x_.first) / (x_.last - x_.first),
          box_.bottom() - box_.height * (data.y - y_.first) / (y_.last - y_.first)};
}

std::vector<PlotPoint> PlotFrame::map(std::span<const PlotPoint> data) const {
  std::vector<PlotPoint> pixels;
  for (const PlotPoint& p : data) pixels.push_back(map(p));
  return pixels;
}

void PlotFrame::draw_grid(SvgDrawing& svg) const {
  const std::vector<double> at_x = plot_ticks(x_.first, x_.last, static_cast<int>(box_.width / 65.0));
  for (const double tick : at_x) {
    const double x = map({tick, y_.first}).x;
    svg.line({x, box_.top}, {x, box_.bottom()}, kGrid, 1.0);
    svg.line({x, box_.bottom()}, {x, box_.bottom() + 5.0}, kFrame, 1.0);
    svg.text({x, box_.bottom() + 19.0}, tick_label(tick, at_x.size() > 1 ? at_x[1] - at_x[0] : 1.0),
             {.anchor = SvgDrawing::Anchor::middle});
  }
  const std::vector<double> at_y = plot_ticks(y_.first, y_.last, static_cast<int>(box_.height / 35.0));
  for (const double tick : at_y) {
    const double y = map({x_.first, tick}).y;
    svg.line({box_.left, y}, {box_.right(), y}, kGrid, 1.0);
    svg.line({box_.left - 5.0, y}, {box_.left, y}, kFrame, 1.0);
    svg.text({box_.left - 9.0, y + 4.0}, tick_label(tick, at_y.size() > 1 ? at_y[1] - at_y[0] : 1.0),
             {.anchor = SvgDrawing::Anchor::end});
  }
  svg.line({box_.left, box_.bottom()}, {box_.right(), box_.bottom()}, kFrame, 1.0);
  svg.line({box_.left, box_.top}, {box_.left, box_.bottom()}, kFrame, 1.0);
  svg.text({box_.left + 0.5 * box_.width, box_.bottom() + 38.0}, x_.label,
           {.size = 13.0, .anchor = SvgDrawing::Anchor::middle});
  svg.text({box_.left - 52.0, box_.top + 0.5 * box_.height}, y_.label,
           {.size = 13.0, .anchor = SvgDrawing::Anchor::middle, .upright = true});
}

namespace {
constexpr std::array<std::string_view, 6> kLineColors{"#0072b2", "#d55e00", "#009e73",
                                                      "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array<std::string_view, 3> kLineDashes{"", "7 3", "2 3"};
}  // namespace

std::string_view line_color(int index) {
  return kLineColors[static_cast<std::size_t>(index) % kLineColors.size()];
}

std::string_view line_dashes(int index) {
  return kLineDashes[static_cast<std::size_t>(index) / kLineColors.size() % kLineDashes.size()];
}

}  // namespace photopic
