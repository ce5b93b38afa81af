#include "spectral/color.h"

#include <cmath>
#include <stdexcept>

namespace photopic {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

std::array<double, 3> multiply(const Matrix& m, double x, double y, double z) {
  std::array<double, 3> out;
  for (int i = 0; i < 3; ++i) out[i] = m[i][0] * x + m[i][1] * y + m[i][2] * z;
  return out;
}

Matrix inverse(const Matrix& m) {
  Matrix out;
  const auto minor_of = [&m](int i, int j) {
    const int r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
    return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
  };
  const double determinant = m[0][0] * minor_of(0, 0) + m[0][1] * minor_of(0, 1) + m[0][2] * minor_of(0, 2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[j][i] = minor_of(i, j) / determinant;
  return out;
}

Xyz from_chromaticity(double x, double y) {
  return {x / y, 1.0, (1.0 - x - y) / y};
}

struct SrgbMatrices {
  Matrix to_xyz, from_xyz;
};

/// Columns are the primaries, scaled so that R = G = B = 1 is the white point.
SrgbMatrices derive_matrices() {
  const Xyz r = from_chromaticity(0.64, 0.33), g = from_chromaticity(0.30, 0.60),
            b = from_chromaticity(0.15, 0.06);
  const Xyz white = d65_white();
  Matrix primaries = {{{r.x, g.x, b.x}, {r.y, g.y, b.y}, {r.z, g.z, b.z}}};
  const auto scale = multiply(inverse(primaries), white.x, white.y, white.z);
  for (auto& row : primaries)
    for (int j = 0; j < 3; ++j) row[j] *= scale[j];
  return {primaries, inverse(primaries)};
}

const SrgbMatrices& srgb_matrices() {
  static const SrgbMatrices matrices = derive_matrices();
  return matrices;
}

}  // namespace

Xyz d65_white() {
  return from_chromaticity(0.3127, 0.3290);
}

Rgb xyz_to_linear_srgb(Xyz xyz) {
  const auto c = multiply(srgb_matrices().from_xyz, xyz.x, xyz.y, xyz.z);
  return {c[0], c[1], c[2]};
}

Xyz linear_srgb_to_xyz(Rgb rgb) {
  const auto c = multiply(srgb_matrices().to_xyz, rgb.r, rgb.g, rgb.b);
  return {c[0], c[1], c[2]};
}

ChromaticAdaptation::ChromaticAdaptation(Xyz from, Xyz to) {
  static constexpr Matrix kBradford = {
      {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const auto cones = [](Xyz white) { return multiply(kBradford, white.x / white.y, 1.0, white.z / white.y); };
  const auto a = cones(from), b = cones(to);
  for (int i = 0; i < 3; ++i)
    if (!(from.y > 0.0 && to.y > 0.0 && a[i] > 0.0 && b[i] > 0.0))
      throw std::invalid_argument("this white is too saturated for an eye to adapt to");
  const Matrix back = inverse(kBradford);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      m_[i][j] = 0.0;
      for (int k = 0; k < 3; ++k) m_[i][j] += back[i][k] * b[k] / a[k] * kBradford[k][j];
    }
}

double srgb_encode(double linear) {
  const double a = std::abs(linear);
  return std::copysign(a <= 0.0031308 ? 12.92 * a : 1.055 * std::pow(a, 1.0 / 2.4) - 0.055, linear);
}

double srgb_decode(double encoded) {
  const double a = std::abs(encoded);
  return std::copysign(a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4), encoded);
}

Lab xyz_to_lab(Xyz xyz, Xyz white) {
  const auto f = [](double t) {
    constexpr double kLimit = 6.0 / 29.0;
    return t > kLimit * kLimit * kLimit ? std::cbrt(t) : t / (3.0 * kLimit * kLimit) + 4.0 / 29.0;
  };
  const double fx = f(xyz.x / white.x), fy = f(xyz.y / white.y), fz = f(xyz.z / white.z);
  return {116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)};
}

}  // namespace photopic
