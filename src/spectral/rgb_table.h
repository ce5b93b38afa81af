#pragma once

#include "spectral/rgb_upsampling.h"

namespace photopic {

/// What upsample_reflectance gives, from a table made when the program is built (Jakob & Hanika 2019, section
/// 4), fast enough for every look-up of a texture. The round trip to linear sRGB under D65 is within ΔE*ab
/// 0.11 on average over the 8-bit sRGB cube, within 1 at most (dark purples: 2). Components are clamped to
/// [0, 1] first, NaN to 0; greys come out constant.
SigmoidPolynomial tabulated_reflectance(float r, float g, float b);

/// The table's layout. The cube is cut in three by which channel is the largest; in each part the axes are
/// that channel, z, and the other two, in cyclic order, over it. Stored are (c0, c1, c2 − the c2 of the mean
/// grey)·√z, which vary less than the coefficients.
namespace rgb_table {

inline constexpr int kSize = 32;  ///< nodes an axis
inline constexpr int kCount = 3 * kSize * kSize * kSize * 3;

/// Each axis is finer at its ends, where the coefficients bend most: smoothstep.
constexpr double node(int i) {
  const double x = static_cast<double>(i) / (kSize - 1);
  return x * x * (3.0 - 2.0 * x);
}

/// Index of a node's first number. @param largest channel @param i of z @param j of the next channel @param k
/// of the one after it
constexpr int index(int largest, int i, int j, int k) {
  return 3 * (((largest * kSize + i) * kSize + j) * kSize + k);
}

}  // namespace rgb_table
}  // namespace photopic
