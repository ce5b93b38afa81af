#include "optimize/color_metric.h"

#include <algorithm>
#include <cmath>

#include "spectral/color_difference.h"

namespace photopic {
namespace {

constexpr double kRounding = 0.1;  ///< ε of smooth_delta_e: a tenth of what an eye can just tell apart

double& component(Xyz& v, int i) {
  return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

/// Steps of a part of each component, but not of next to nothing where a saturated colour has none of it.
Xyz steps(Xyz c, double part) {
  const double floor = 0.01 * std::max({c.x, c.y, c.z});
  return Xyz{std::max(c.x, floor), std::max(c.y, floor), std::max(c.z, floor)} * part;
}

double squared_delta_e(const Lab& reference, Xyz sample, Xyz white) {
  const double delta_e = delta_e_2000(reference, xyz_to_lab(sample, white));
  return delta_e * delta_e;
}

}  // namespace

ColorMetric color_metric(Xyz c, Xyz white) {
  if (!(std::max({c.x, c.y, c.z}) > 0.0)) return {};
  const Lab reference = xyz_to_lab(c, white);
  Xyz step = steps(c, 1e-3);
  const auto at = [&](int i, double si, int j, double sj) {
    Xyz sample = c;
    component(sample, i) += si * component(step, i);
    component(sample, j) += sj * component(step, j);
    return squared_delta_e(reference, sample, white);
  };

  // ΔE² vanishes at c together with its gradient: differences of values around c are its Hessian.
  double j[3][3];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b <= a; ++b) {
      const double area = component(step, a) * component(step, b);
      j[a][b] = a == b
                    ? (at(a, 1, a, 0) + at(a, -1, a, 0)) / (2.0 * area)
                    : (at(a, 1, b, 1) + at(a, -1, b, -1) - at(a, 1, b, -1) - at(a, -1, b, 1)) / (8.0 * area);
    }

  // J = L Lᵀ; the rows of U are the columns of L.
  double l[3][3] = {};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b <= a; ++b) {
      double rest = j[a][b];
      for (int k = 0; k < b; ++k) rest -= l[a][k] * l[b][k];
      l[a][b] = a == b ? std::sqrt(std::max(rest, 1e-6 * j[a][a])) : rest / l[b][b];
    }
  return {Xyz{l[0][0], l[1][0], l[2][0]}, Xyz{0.0, l[1][1], l[2][1]}, Xyz{0.0, 0.0, l[2][2]}};
}

Xyz measured(const ColorMetric& u, Xyz d) {
  const auto dot = [&](Xyz row) { return row.x * d.x + row.y * d.y + row.z * d.z; };
  return {dot(u[0]), dot(u[1]), dot(u[2])};
}

SmoothDeltaE smooth_delta_e(const Lab& reference, Xyz sample, Xyz white) {
  Xyz step = steps(sample, 1e-5);
  Xyz gradient_of_square;
  for (int i = 0; i < 3; ++i) {
    Xyz above = sample, below = sample;
    component(above, i) += component(step, i);
    component(below, i) -= component(step, i);
    component(gradient_of_square, i) =
        (squared_delta_e(reference, above, white) - squared_delta_e(reference, below, white)) /
        (2.0 * component(step, i));
  }
  const double root = std::sqrt(squared_delta_e(reference, sample, white) + kRounding * kRounding);
  return {root - kRounding, gradient_of_square * (0.5 / root)};
}

}  // namespace photopic
