#include "spectral/observer.h"

#include <algorithm>
#include <cmath>

#include "spectral/spectrum.h"

namespace photopic {
namespace {

using Rows = std::array<std::array<double, 3>, Observer::kTableSize>;

constexpr Rows kCie1931 = {{
#include "spectral/tables/cie1931.inc"
}};

constexpr Rows kCie1964 = {{
#include "spectral/tables/cie1964.inc"
}};

Observer from_rows(const Rows& rows) {
  Observer::Table x, y, z;
  for (int i = 0; i < Observer::kTableSize; ++i) {
    x[i] = rows[i][0];
    y[i] = rows[i][1];
    z[i] = rows[i][2];
  }
  return {x, y, z};
}

/// ∫ h·I over [a, b], both linear there: Simpson's rule is exact for their product.
Xyz integrate_cell(const Observer& observer, double a, double b, double power_a, double power_b) {
  const Xyz h_a = observer(a), h_b = observer(b);
  const Xyz middle = (h_a + h_b) * (power_a + power_b);  // 4 · (h_a + h_b)/2 · (I_a + I_b)/2
  return (h_a * power_a + middle + h_b * power_b) * ((b - a) / 6.0);
}

}  // namespace

const Observer& Observer::cie1931() {
  static const Observer observer = from_rows(kCie1931);
  return observer;
}

const Observer& Observer::cie1964() {
  static const Observer observer = from_rows(kCie1964);
  return observer;
}

Observer::Observer(const Table& x_bar, const Table& y_bar, const Table& z_bar) {
  for (int i = 0; i < kTableSize; ++i) table_[i] = {x_bar[i], y_bar[i], z_bar[i]};
  y_integral_ = -0.5 * (y_bar.front() + y_bar.back());
  for (double y : y_bar) y_integral_ += y;
}

Xyz emission_xyz(const TabulatedSpectrum& emission, const Observer& observer) {
  Xyz sum;
  const auto lambda = emission.lambda(), value = emission.value();
  for (std::size_t i = 0; i + 1 < lambda.size(); ++i) {
    const double width = lambda[i + 1] - lambda[i];
    const double end = std::min(lambda[i + 1], kLambdaMax);
    const auto power = [&](double x) {
      const double f = (x - lambda[i]) / width;
      return value[i] * (1.0 - f) + value[i + 1] * f;
    };
    // Split the emission's cell where the observer has its knots, at every nm.
    for (double a = std::max(lambda[i], kLambdaMin); a < end;) {
      const double b = std::min(std::floor(a) + 1.0, end);
      sum += integrate_cell(observer, a, b, power(a), power(b));
      a = b;
    }
  }
  return sum * (1.0 / observer.y_integral());
}

double luminance(const TabulatedSpectrum& emission) {
  return emission_xyz(emission, Observer::cie1931()).y;
}

}  // namespace photopic
