#pragma once

#include <algorithm>

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

class Axis {
 public:
  /// A cell's first node, and how much of the cell a unit is.
  struct Cell {
    float node, per_unit;
  };

  constexpr Axis() {
    for (int i = 0; i < kSize; ++i) cells_[i].node = static_cast<float>(rgb_table::node(i));
    for (int i = 0; i + 1 < kSize; ++i) cells_[i].per_unit = 1.0f / (cells_[i + 1].node - cells_[i].node);
    cells_[kSize - 1].node = 2.0f;  // nothing lies beyond
    for (int i = 0; i < kHints; ++i) {
      int cell = i == 0 ? 0 : hint_[i - 1];
      while (cells_[cell + 1].node * kHints <= static_cast<float>(i)) ++cell;
      hint_[i] = static_cast<unsigned char>(cell);
    }
  }

  /// The cell that holds x in [0, 1].
  int find(float x) const {
    const int cell = hint_[std::min(static_cast<int>(x * kHints), kHints - 1)];
    return cell + (cells_[cell + 1].node <= x);
  }
  const Cell& operator[](int cell) const { return cells_[cell]; }

 private:
  static constexpr int kHints = 512;
  static_assert(node(1) > 1.0 / kHints, "there is at most one node between two hints");
  Cell cells_[kSize]{};
  unsigned char hint_[kHints]{};  ///< the cell of i/kHints
};
inline constexpr Axis kAxis;

extern const float kNodes[];  ///< kCount of them and two more that mean nothing; generated

}  // namespace rgb_table
}  // namespace photopic
