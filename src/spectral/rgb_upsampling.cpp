#include "spectral/rgb_upsampling.h"

#include <array>

#include "spectral/illuminants.h"
#include "spectral/observer.h"
#include "spectral/spectrum.h"

namespace photopic {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

constexpr int kNodes = 189;  ///< every 2.5 nm
constexpr double kStep = (kLambdaMax - kLambdaMin) / (kNodes - 1);

/// The polynomial is fitted in t = (λ − 560)/100, which conditions the problem far better than x = (λ −
/// 360)/470.
constexpr double kCentre = 560.0, kWidth = 100.0;

/// Linear sRGB of a reflectance R under D65 is Σ_i weight[k][i]·R(λ_i): R linear between nodes.
struct Quadrature {
  std::array<double, kNodes> t;
  std::array<std::array<double, kNodes>, 3> weight;
};

Quadrature make_quadrature() {
  const TabulatedSpectrum d65 = tabulate_emission(*cie_illuminant("D65"));
  const double white_y = emission_xyz(d65, Observer::cie1931()).y;
  Quadrature q;
  for (int i = 0; i < kNodes; ++i) {
    const double lambda = kLambdaMin + kStep * i;
    q.t[i] = (lambda - kCentre) / kWidth;
    // The node's hat function times D65, on knots every quarter of a nm.
    std::vector<double> knots, values;
    for (double x = std::max(lambda - kStep, kLambdaMin); x <= std::min(lambda + kStep, kLambdaMax);
         x += 0.25) {
      knots.push_back(x);
      values.push_back(d65(x) * (1.0 - std::abs(x - lambda) / kStep));
    }
    const TabulatedSpectrum lit(std::move(knots), std::move(values), Beyond::zero);
    const Rgb rgb = xyz_to_linear_srgb(emission_xyz(lit, Observer::cie1931()) * (1.0 / white_y));
    q.weight[0][i] = rgb.r;
    q.weight[1][i] = rgb.g;
    q.weight[2][i] = rgb.b;
  }
  return q;
}

/// What a set of coefficients gives: the residual in linear sRGB and its derivatives.
struct Fit {
  Vector coefficients;  ///< of t², t, 1
  Vector residual;
  Matrix jacobian;
  double error = 0;  ///< squared length of the residual
};

Fit evaluate_fit(const Quadrature& q, const Vector& c, const Vector& target) {
  // Reflectance and its derivatives at the nodes, then their sums with the three weights.
  std::array<double, kNodes> value, d0, d1, d2;
  for (int i = 0; i < kNodes; ++i) {
    const double t = q.t[i], y = (c[0] * t + c[1]) * t + c[2];
    const double root = 1.0 / std::sqrt(1.0 + y * y);
    value[i] = 0.5 + 0.5 * y * root;
    d2[i] = 0.5 * root * root * root;
    d1[i] = d2[i] * t;
    d0[i] = d1[i] * t;
  }
  Fit fit{c, {}, {}};
  for (int k = 0; k < 3; ++k) {
    double sum = 0, s0 = 0, s1 = 0, s2 = 0;
    for (int i = 0; i < kNodes; ++i) {
      const double w = q.weight[k][i];
      sum += w * value[i];
      s0 += w * d0[i];
      s1 += w * d1[i];
      s2 += w * d2[i];
    }
    fit.residual[k] = sum - target[k];
    fit.jacobian[k] = {s0, s1, s2};
    fit.error += fit.residual[k] * fit.residual[k];
  }
  return fit;
}

double determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The step −(JᵀJ + damping·diag(JᵀJ))⁻¹ Jᵀr of Levenberg and Marquardt.
Vector damped_step(const Fit& fit, double damping) {
  Matrix normal{};
  Vector right{};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      right[i] -= fit.jacobian[k][i] * fit.residual[k];
      for (int j = 0; j < 3; ++j) normal[i][j] += fit.jacobian[k][i] * fit.jacobian[k][j];
    }
  for (int i = 0; i < 3; ++i) normal[i][i] = normal[i][i] * (1.0 + damping) + 1e-30;
  const double d = determinant(normal[0], normal[1], normal[2]);  // symmetric: rows are columns
  return {determinant(right, normal[1], normal[2]) / d, determinant(normal[0], right, normal[2]) / d,
          determinant(normal[0], normal[1], right) / d};
}

/// Gauss–Newton, damped where a full step does not improve.
Fit solve(const Quadrature& q, const Vector& start, const Vector& target) {
  constexpr double kEnough = 1e-12;  // squared
  Fit fit = evaluate_fit(q, start, target);
  double damping = 1e-4;
  for (int iteration = 0; iteration < 60 && fit.error > kEnough; ++iteration) {
    const Vector step = damped_step(fit, damping);
    const Vector c = {fit.coefficients[0] + step[0], fit.coefficients[1] + step[1],
                      fit.coefficients[2] + step[2]};
    const Fit next = evaluate_fit(q, c, target);
    if (next.error < fit.error) {
      fit = next;
      damping *= 0.1;
    } else {
      damping = std::max(damping * 10.0, 1e-6);
      if (damping > 1e12) break;
    }
  }
  return fit;
}

SigmoidPolynomial to_sigmoid(const Vector& c) {
  // t = a·x + b
  const double a = (kLambdaMax - kLambdaMin) / kWidth, b = (kLambdaMin - kCentre) / kWidth;
  return {static_cast<float>(c[0] * a * a), static_cast<float>((2.0 * c[0] * b + c[1]) * a),
          static_cast<float>((c[0] * b + c[1]) * b + c[2])};
}

}  // namespace

SigmoidPolynomial upsample_reflectance(const Rgb& linear_srgb) {
  static const Quadrature quadrature = make_quadrature();
  const auto clamp = [](double v) { return v > 0.0 ? std::min(v, 1.0) : 0.0; };
  const Vector target = {clamp(linear_srgb.r), clamp(linear_srgb.g), clamp(linear_srgb.b)};
  // A grey is a constant, black and white exactly so.
  if (target[0] == target[1] && target[1] == target[2]) return constant_sigmoid(target[0]);

  const double mean = (target[0] + target[1] + target[2]) / 3.0;
  return to_sigmoid(solve(quadrature, {0.0, 0.0, constant_sigmoid(mean).c2}, target).coefficients);
}

}  // namespace photopic
