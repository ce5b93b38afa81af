#include "spectral/rgb_table.h"

#include <algorithm>
#include <array>

namespace photopic {
namespace rgb_table {

extern const float kNodes[];  // kCount of them, generated

namespace {

/// Where a coordinate falls on an axis.
struct Place {
  int cell;
  float fraction;
};

class Axis {
 public:
  constexpr Axis() {
    for (int i = 0; i < kSize; ++i) nodes_[i] = static_cast<float>(node(i));
    for (int i = 0; i < kHints; ++i) {
      int cell = i == 0 ? 0 : hint_[i - 1];
      while (cell < kSize - 2 && nodes_[cell + 1] * kHints <= static_cast<float>(i)) ++cell;
      hint_[i] = static_cast<unsigned char>(cell);
    }
  }

  /// @param x in [0, 1]
  Place find(float x) const {
    int cell = hint_[std::min(static_cast<int>(x * kHints), kHints - 1)];
    while (cell < kSize - 2 && nodes_[cell + 1] <= x) ++cell;
    return {cell, (x - nodes_[cell]) / (nodes_[cell + 1] - nodes_[cell])};
  }

 private:
  static constexpr int kHints = 256;
  float nodes_[kSize]{};
  unsigned char hint_[kHints]{};  ///< the cell of i/kHints
};
constexpr Axis kAxis;

SigmoidPolynomial mix(const SigmoidPolynomial& a, const SigmoidPolynomial& b, float f) {
  return {a.c0 + (b.c0 - a.c0) * f, a.c1 + (b.c1 - a.c1) * f, a.c2 + (b.c2 - a.c2) * f};
}

SigmoidPolynomial interpolate(int largest, Place z, Place y, Place x) {
  const auto row = [&](int i, int j) -> SigmoidPolynomial {
    const float* n = &kNodes[index(largest, z.cell + i, y.cell + j, x.cell)];
    return mix({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, x.fraction);
  };
  return mix(mix(row(0, 0), row(0, 1), y.fraction), mix(row(1, 0), row(1, 1), y.fraction), z.fraction);
}

}  // namespace
}  // namespace rgb_table

SigmoidPolynomial tabulated_reflectance(float r, float g, float b) {
  using namespace rgb_table;
  const auto clamp = [](float v) { return v > 0.0f ? std::min(v, 1.0f) : 0.0f; };
  const std::array<float, 3> rgb{clamp(r), clamp(g), clamp(b)};
  if (rgb[0] == rgb[1] && rgb[1] == rgb[2]) return constant_sigmoid(rgb[0]);

  const std::size_t largest = rgb[0] > rgb[1] ? (rgb[0] > rgb[2] ? 0 : 2) : (rgb[1] > rgb[2] ? 1 : 2);
  const float z = rgb[largest];
  const SigmoidPolynomial s =
      interpolate(static_cast<int>(largest), kAxis.find(z), kAxis.find(rgb[(largest + 1) % 3] / z),
                  kAxis.find(rgb[(largest + 2) % 3] / z));
  const float grey = constant_sigmoid((rgb[0] + rgb[1] + rgb[2]) * (1.0f / 3.0f)).c2;
  const float scale = 1.0f / std::sqrt(z);
  return {s.c0 * scale, s.c1 * scale, s.c2 * scale + grey};
}

}  // namespace photopic
