#pragma once

#include <array>

namespace photopic {

/// CIE XYZ tristimulus values, or three of anything indexed X, Y, Z.
struct Xyz {
  double x = 0, y = 0, z = 0;

  friend Xyz operator+(Xyz a, Xyz b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Xyz operator-(Xyz a, Xyz b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Xyz operator*(Xyz a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  Xyz& operator+=(Xyz b) { return *this = *this + b; }
};

/// Linear Rec. 709 / sRGB primaries, D65 white, unclipped.
struct Rgb {
  double r = 0, g = 0, b = 0;
};

/// CIE 1976 L*a*b*.
struct Lab {
  double l = 0, a = 0, b = 0;
};

/// The D65 white point with Y = 1, from the sRGB standard's chromaticity (0.3127, 0.3290).
Xyz d65_white();

/// XYZ (D65 white at Y = 1) to linear sRGB and back; the matrices are derived from the primaries and the
/// white point of IEC 61966-2-1, and are each other's inverse to rounding.
Rgb xyz_to_linear_srgb(Xyz xyz);
Xyz linear_srgb_to_xyz(Rgb rgb);

/// Linear Bradford adaptation (ICC.1:2022, annex E): what an eye used to the white `from` sees, as one used
/// to the white `to` would need it. Only the whites' chromaticities count: Y of a white is kept.
class ChromaticAdaptation {
 public:
  ChromaticAdaptation() = default;  ///< changes nothing
  /// @throws std::invalid_argument when a white is no colour of light: Y ≤ 0, or beyond what the cones can
  /// tell
  ChromaticAdaptation(Xyz from, Xyz to);

  Xyz operator()(Xyz xyz) const {
    return {m_[0][0] * xyz.x + m_[0][1] * xyz.y + m_[0][2] * xyz.z,
            m_[1][0] * xyz.x + m_[1][1] * xyz.y + m_[1][2] * xyz.z,
            m_[2][0] * xyz.x + m_[2][1] * xyz.y + m_[2][2] * xyz.z};
  }

 private:
  std::array<std::array<double, 3>, 3> m_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

/// The sRGB transfer functions (IEC 61966-2-1), extended as odd functions below zero.
double srgb_encode(double linear);
double srgb_decode(double encoded);

/// XYZ to L*a*b* relative to a white (CIE 15:2018, 8.2.1), continued linearly below (6/29)³, negative values
/// too.
Lab xyz_to_lab(Xyz xyz, Xyz white);

}  // namespace photopic
