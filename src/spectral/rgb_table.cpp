#include "spectral/rgb_table.h"

#include <algorithm>
#include <array>

#include "spectral/float_vectors.h"

namespace photopic {
namespace rgb_table {

extern const float kNodes[];  // kCount of them and one more, generated

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
    for (int i = 0; i + 1 < kSize; ++i) per_unit_[i] = 1.0f / (nodes_[i + 1] - nodes_[i]);
    nodes_[kSize - 1] = 2.0f;  // nothing lies beyond
    for (int i = 0; i < kHints; ++i) {
      int cell = i == 0 ? 0 : hint_[i - 1];
      while (nodes_[cell + 1] * kHints <= static_cast<float>(i)) ++cell;
      hint_[i] = static_cast<unsigned char>(cell);
    }
  }

  /// @param x in [0, 1]
  Place find(float x) const {
    int cell = hint_[std::min(static_cast<int>(x * kHints), kHints - 1)];
    cell += nodes_[cell + 1] <= x;
    return {cell, (x - nodes_[cell]) * per_unit_[cell]};
  }

 private:
  static constexpr int kHints = 512;
  static_assert(node(1) > 1.0 / kHints, "there is at most one node between two hints");
  float nodes_[kSize]{}, per_unit_[kSize]{};
  unsigned char hint_[kHints]{};  ///< the cell of i/kHints
};
constexpr Axis kAxis;

/// Three coefficients, and a fourth number that means nothing.
Float4 interpolate(int largest, Place z, Place y, Place x) {
  const float* first = &kNodes[index(largest, z.cell, y.cell, x.cell)];
  constexpr int kNextX = index(0, 0, 0, 1), kNextY = index(0, 0, 1, 0), kNextZ = index(0, 1, 0, 0);
  const auto mix = [](Float4 a, Float4 b, float f) { return a + (b - a) * f; };
  const auto row = [&](const float* n) { return mix(load<Float4>(n), load<Float4>(n + kNextX), x.fraction); };
  return mix(mix(row(first), row(first + kNextY), y.fraction),
             mix(row(first + kNextZ), row(first + kNextZ + kNextY), y.fraction), z.fraction);
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
  const Float4 s =
      interpolate(static_cast<int>(largest), kAxis.find(z), kAxis.find(rgb[(largest + 1) % 3] / z),
                  kAxis.find(rgb[(largest + 2) % 3] / z));
  const float grey = constant_sigmoid((rgb[0] + rgb[1] + rgb[2]) * (1.0f / 3.0f)).c2;
  const float scale = 1.0f / std::sqrt(z);
  return {s[0] * scale, s[1] * scale, s[2] * scale + grey};
}

}  // namespace photopic
