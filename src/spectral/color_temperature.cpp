#include "spectral/color_temperature.h"

#include <cmath>

#include "spectral/observer.h"
#include "spectral/spectrum.h"

namespace photopic {
namespace {

/// CIE 1960: u = 4X/(X + 15Y + 3Z), v = 6Y/(X + 15Y + 3Z).
struct Uv {
  double u, v;
};

Uv uv_1960(Xyz c) {
  const double sum = c.x + 15.0 * c.y + 3.0 * c.z;
  return {4.0 * c.x / sum, 6.0 * c.y / sum};
}

/// The Planckian locus at 1/T [1/K]; equal steps of 1/T are roughly equal steps along it.
Uv planckian(double reciprocal) {
  return uv_1960(emission_xyz(tabulate_emission(BlackbodySpectrum{1.0 / reciprocal}), Observer::cie1931()));
}

double squared_distance(Uv a, Uv b) {
  return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
}

constexpr double kFirst = 1.0 / 25000.0, kLast = 1.0 / 1000.0;
constexpr int kSteps = 64;

double scan_point(int i) {
  return kFirst + (kLast - kFirst) * i / kSteps;
}

/// The minimum of a function with one valley in [low, high].
template <typename Function>
double golden_section(Function f, double low, double high) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = f(a), at_b = f(b);
  while (high - low > 1e-10) {  // 0.001 K at 3200 K, 0.004 K at 6500 K
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      at_a = f(a = high - ratio * (high - low));
    } else {
      low = a, a = b, at_a = at_b;
      at_b = f(b = low + ratio * (high - low));
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

Chromaticity chromaticity(Xyz xyz) {
  const double sum = xyz.x + xyz.y + xyz.z;
  return {xyz.x / sum, xyz.y / sum};
}

std::optional<CorrelatedTemperature> correlated_temperature(Xyz xyz) {
  const Uv lamp = uv_1960(xyz);
  const auto distance = [&](double reciprocal) { return squared_distance(lamp, planckian(reciprocal)); };

  // Far from the locus there may be two valleys: begin in the deeper one.
  int nearest = 0;
  double least = distance(scan_point(0));
  for (int i = 1; i <= kSteps; ++i)
    if (const double here = distance(scan_point(i)); here < least) least = here, nearest = i;
  const double from = scan_point(nearest > 0 ? nearest - 1 : 0);
  const double to = scan_point(nearest < kSteps ? nearest + 1 : kSteps);
  const double best = golden_section(distance, from, to);

  constexpr double kAtEnd = 1e-9;
  if (best < kFirst + kAtEnd || best > kLast - kAtEnd) return std::nullopt;
  const Uv locus = planckian(best);
  const double sign = lamp.v >= locus.v ? 1.0 : -1.0;
  return CorrelatedTemperature{1.0 / best, sign * std::sqrt(squared_distance(lamp, locus))};
}

}  // namespace photopic
