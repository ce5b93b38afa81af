#include "spectral/color_difference.h"

#include <cmath>
#include <numbers>

namespace photopic {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

double pow7(double x) {
  return x * x * x * x * x * x * x;
}

/// sqrt(C⁷ / (C⁷ + 25⁷)), which equations 4 and 19 share.
double chroma_weight(double chroma) {
  return std::sqrt(pow7(chroma) / (pow7(chroma) + pow7(25.0)));
}

/// Hue angle in [0, 2π), 0 for a grey: equation 7.
double hue(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  const double angle = std::atan2(b, a);
  return angle < 0.0 ? angle + 2.0 * kPi : angle;
}

}  // namespace

double delta_e_2000(const Lab& reference, const Lab& sample) {
  // Equations 2–7: C', h' with a stretched for low chroma.
  const double mean_ab = 0.5 * (std::hypot(reference.a, reference.b) + std::hypot(sample.a, sample.b));
  const double stretch = 1.0 + 0.5 * (1.0 - chroma_weight(mean_ab));
  const double a1 = stretch * reference.a, a2 = stretch * sample.a;
  const double c1 = std::hypot(a1, reference.b), c2 = std::hypot(a2, sample.b);
  const double h1 = hue(a1, reference.b), h2 = hue(a2, sample.b);
  const bool grey = c1 * c2 == 0.0;

  // Equations 8–11: the differences; hue the shorter way round.
  const double dl = sample.l - reference.l, dc = c2 - c1;
  double dh = grey ? 0.0 : h2 - h1;
  if (dh > kPi) dh -= 2.0 * kPi;
  if (dh < -kPi) dh += 2.0 * kPi;
  const double dh_chord = 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * dh);

  // Equations 12–14: the means.
  const double l = 0.5 * (reference.l + sample.l), c = 0.5 * (c1 + c2);
  double h = h1 + h2;
  if (!grey) {
    if (std::abs(h1 - h2) > kPi) h += h < 2.0 * kPi ? 2.0 * kPi : -2.0 * kPi;
    h *= 0.5;
  }

  // Equations 15–21: weights and the rotation of the blue region.
  const double t = 1.0 - 0.17 * std::cos(h - 30.0 * kDegree) + 0.24 * std::cos(2.0 * h) +
                   0.32 * std::cos(3.0 * h + 6.0 * kDegree) - 0.20 * std::cos(4.0 * h - 63.0 * kDegree);
  const double from_blue = (h / kDegree - 275.0) / 25.0;
  const double rotation = 30.0 * kDegree * std::exp(-from_blue * from_blue);
  const double l50 = (l - 50.0) * (l - 50.0);
  const double s_l = 1.0 + 0.015 * l50 / std::sqrt(20.0 + l50), s_c = 1.0 + 0.045 * c,
               s_h = 1.0 + 0.015 * c * t;
  const double r_t = -std::sin(2.0 * rotation) * 2.0 * chroma_weight(c);

  // Equation 22.
  const double l_term = dl / s_l, c_term = dc / s_c, h_term = dh_chord / s_h;
  const double square = l_term * l_term + c_term * c_term + h_term * h_term + r_t * c_term * h_term;
  // The quadratic form is positive (|R_T| < 2); rounding alone could bring it below zero.
  return square < 0.0 ? 0.0 : std::sqrt(square);
}

}  // namespace photopic
