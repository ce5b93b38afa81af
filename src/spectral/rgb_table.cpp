#include "spectral/rgb_table.h"

#include <array>

#include "spectral/float_vectors.h"

namespace photopic {
namespace rgb_table {
namespace {

/// Where a coordinate falls on an axis.
struct Place {
  explicit Place(float x) : cell(kAxis.find(x)), fraction((x - kAxis[cell].node) * kAxis[cell].per_unit) {}
  int cell;
  float fraction;
};

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
  const Float4 s = interpolate(static_cast<int>(largest), Place(z), Place(rgb[(largest + 1) % 3] / z),
                               Place(rgb[(largest + 2) % 3] / z));
  const float grey = constant_sigmoid((rgb[0] + rgb[1] + rgb[2]) * (1.0f / 3.0f)).c2;
  const float scale = 1.0f / std::sqrt(z);
  return {s[0] * scale, s[1] * scale, s[2] * scale + grey};
}

}  // namespace photopic
