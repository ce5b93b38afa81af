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

/// The sRGB transfer functions (IEC 61966-2-1), extended as odd functions below zero.
double srgb_encode(double linear);
double srgb_decode(double encoded);

/// XYZ to L*a*b* relative to a white (CIE 15:2018, 8.2.1), continued linearly below (6/29)³, negative values
/// too.
Lab xyz_to_lab(Xyz xyz, Xyz white);

}  // namespace photopic
