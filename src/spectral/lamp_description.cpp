#include "spectral/lamp_description.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "spectral/observer.h"
#include "spectral/piecewise_density.h"

namespace photopic {
namespace {

constexpr double kReach = 15.0, kWidest = 12.0;  ///< [nm]
constexpr double kValley = 0.75, kLeastHeight = 0.2, kLeastPower = 0.002;

double power(const TabulatedSpectrum& emission) {
  const auto x = emission.lambda(), y = emission.value();
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) sum += 0.5 * (x[i + 1] - x[i]) * (y[i] + y[i + 1]);
  return sum;
}

struct Point {
  double x, y;
};

/// A maximum: its first and last knot (it may be flat).
struct Peak {
  std::size_t first, last;
};

std::vector<Peak> peaks_by_height(const TabulatedSpectrum& emission) {
  const auto y = emission.value();
  std::vector<Peak> peaks;
  for (std::size_t i = 1; i < y.size(); ++i) {
    if (!(y[i] > y[i - 1])) continue;
    std::size_t last = i;
    while (last + 1 < y.size() && y[last + 1] == y[i]) ++last;
    if (last + 1 < y.size() && y[last + 1] < y[i]) peaks.push_back({i, last});
  }
  std::stable_sort(peaks.begin(), peaks.end(), [&](Peak a, Peak b) { return y[a.first] > y[b.first]; });
  return peaks;
}

/// The lowest place within reach of knot `start`, going in steps of ±1 until another peak rises.
Point find_foot(const TabulatedSpectrum& emission, std::size_t start, int step) {
  const auto x = emission.lambda(), y = emission.value();
  const double top = y[start], edge = x[start] + step * kReach;
  Point foot{x[start], top};
  for (std::size_t i = start;;) {
    if ((i == 0 && step < 0) || (i + 1 == x.size() && step > 0)) return foot;
    i += static_cast<std::size_t>(step);
    const bool beyond = step * (x[i] - edge) > 0.0;
    const Point here = beyond ? Point{edge, emission(edge)} : Point{x[i], y[i]};
    if (here.y < foot.y) foot = here;
    if (beyond || y[i] > top || y[i] - foot.y > kValley * (top - foot.y)) return foot;
  }
}

/// The emission between two feet less the higher of them; zero where it dips below. (The end of a table, a
/// foot of zero beside a high one, so makes no line.)
TabulatedSpectrum above_background(const TabulatedSpectrum& emission, Point left, Point right) {
  const double background = std::max(left.y, right.y);
  std::vector<double> x{left.x}, y{0.0};
  const auto lambda = emission.lambda(), value = emission.value();
  const auto first = std::upper_bound(lambda.begin(), lambda.end(), left.x) - lambda.begin();
  for (auto i = static_cast<std::size_t>(first); i < lambda.size() && lambda[i] < right.x; ++i) {
    x.push_back(lambda[i]);
    y.push_back(std::max(0.0, value[i] - background));
  }
  x.push_back(right.x);
  y.push_back(0.0);
  return {std::move(x), std::move(y), Beyond::zero};
}

/// Where a table falls to `level`, going from knot `start` in steps of ±1; its end where it does not.
double crossing(const TabulatedSpectrum& table, std::size_t start, int step, double level) {
  const auto x = table.lambda(), y = table.value();
  std::size_t i = start;
  while (i > 0 && i + 1 < x.size()) {
    const std::size_t next = i + static_cast<std::size_t>(step);
    if (y[next] <= level) return x[i] + (x[next] - x[i]) * (y[i] - level) / (y[i] - y[next]);
    i = next;
  }
  return x[i];
}

double full_width_at_half_height(const TabulatedSpectrum& line) {
  const auto y = line.value();
  const auto top = static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin());
  return crossing(line, top, 1, 0.5 * y[top]) - crossing(line, top, -1, 0.5 * y[top]);
}

}  // namespace

std::vector<EmissionLine> find_lines(const TabulatedSpectrum& emission) {
  const auto x = emission.lambda(), y = emission.value();
  const double all_power = power(emission), all_luminance = luminance(emission);
  struct Span {
    double from, to;
  };
  std::vector<Span> taken;
  std::vector<EmissionLine> lines;
  for (const Peak& peak : peaks_by_height(emission)) {
    const double middle = 0.5 * (x[peak.first] + x[peak.last]);
    const auto holds = [middle](const Span& s) { return middle > s.from && middle < s.to; };
    if (std::any_of(taken.begin(), taken.end(), holds)) continue;  // a shoulder of a higher line

    const Point left = find_foot(emission, peak.first, -1), right = find_foot(emission, peak.last, 1);
    if (!(left.x < right.x)) continue;
    const TabulatedSpectrum line = above_background(emission, left, right);
    const double height = *std::max_element(line.value().begin(), line.value().end());
    const double line_power = power(line), width = full_width_at_half_height(line);
    if (width > kWidest || height < kLeastHeight * (y[peak.first] - height) ||
        line_power < kLeastPower * all_power)
      continue;
    taken.push_back({left.x, right.x});
    lines.push_back(
        {middle, width, line_power / all_power, all_luminance > 0.0 ? luminance(line) / all_luminance : 0.0});
  }
  std::sort(lines.begin(), lines.end(),
            [](const EmissionLine& a, const EmissionLine& b) { return a.wavelength < b.wavelength; });
  return lines;
}

LampDescription describe_lamp(const TabulatedSpectrum& emission) {
  const Observer& observer = Observer::cie1931();
  const Xyz xyz = emission_xyz(emission, observer);
  if (!(xyz.y > 0.0)) throw std::invalid_argument("gives no visible light between 360 and 830 nm");

  LampDescription lamp;
  lamp.chromaticity = chromaticity(xyz);
  lamp.temperature = correlated_temperature(xyz);
  lamp.efficacy = kMaximalEfficacy * xyz.y * observer.y_integral() / power(emission);

  // ȳ·I, linear between the knots of both, is near enough for a quantile.
  std::vector<double> at, weight;
  const auto lambda = emission.lambda(), value = emission.value();
  const double largest = *std::max_element(value.begin(), value.end());
  for (std::size_t i = 0; i < lambda.size(); ++i) {
    at.push_back(lambda[i]);
    weight.push_back(observer(lambda[i]).y * (value[i] / largest));
    const double end = i + 1 < lambda.size() ? lambda[i + 1] : lambda[i];
    for (double nm = std::floor(lambda[i]) + 1.0; nm < end; nm += 1.0) {
      at.push_back(nm);
      weight.push_back(observer(nm).y * (emission(nm) / largest));
    }
  }
  const PiecewiseLinearDensity luminance_density(std::move(at), std::move(weight));
  lamp.luminance_from = luminance_density.inverse(0.05);
  lamp.luminance_to = luminance_density.inverse(0.95);

  const auto peak = std::max_element(value.begin(), value.end());
  if (*std::min_element(value.begin(), value.end()) < *peak)
    lamp.peak = lambda[static_cast<std::size_t>(peak - value.begin())];
  lamp.lines = find_lines(emission);
  return lamp;
}

}  // namespace photopic
