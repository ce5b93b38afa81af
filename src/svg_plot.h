#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace photopic {

struct PlotPoint {
  double x = 0, y = 0;
};

/// An SVG drawing; lengths in pixels from the top left corner. All text is escaped.
class SvgDrawing {
 public:
  SvgDrawing(double width, double height);

  enum class Anchor { start, middle, end };
  struct TextStyle {
    double size = 12.0;
    Anchor anchor = Anchor::start;
    std::string_view color = "#333333";
    bool bold = false;
    bool upright = false;  ///< turned by 90°, read from below
  };
  void text(PlotPoint at, std::string_view content, const TextStyle& style);
  void line(PlotPoint from, PlotPoint to, std::string_view color, double width, std::string_view dashes = "");
  void curve(std::span<const PlotPoint> points, std::string_view color, double width,
             std::string_view dashes = "");
  void area(std::span<const PlotPoint> outline, std::string_view fill, double opacity);

  /// A horizontal colour gradient, for area's `fill`: stops evenly spaced from pixel `from` to `to`.
  /// @return "url(#…)"
  std::string gradient(double from, double to, std::span<const std::string> colors);

  std::string text_of_file() const;

 private:
  double width_, height_;
  int gradients_ = 0;
  std::string body_;
};

/// One axis of a plot, in the units of the data.
struct PlotAxis {
  double first = 0, last = 1;
  std::string label;
};

/// Where a plot's frame stands in the drawing [pixels].
struct PlotBox {
  double left, top, width, height;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

/// Axes and the map from data to pixels.
class PlotFrame {
 public:
  PlotFrame(const PlotBox& box, PlotAxis x, PlotAxis y);

  PlotPoint map(PlotPoint data) const;
  std::vector<PlotPoint> map(std::span<const PlotPoint> data) const;
  const PlotBox& box() const { return box_; }

  void draw_grid(SvgDrawing& svg) const;  ///< grid, ticks and their numbers, labels: below the curves

 private:
  PlotBox box_;
  PlotAxis x_, y_;
};

/// Round numbers from first to last, 1, 2 or 5 times a power of ten apart, `about` of them.
std::vector<double> plot_ticks(double first, double last, int about);

/// Line colours that colour-blind people can tell apart on white: Okabe & Ito 2008, without black and yellow.
/// From the seventh line on they begin again, and the dashes change.
std::string_view line_color(int index);
std::string_view line_dashes(int index);

}  // namespace photopic
