#pragma once

#include <vector>

#include "core/bsdf/microfacet.h"
#include "core/bsdf/table_position.h"

namespace photopic {

/// The axes of albedo tables: cos θ and roughness, each by its fourth root in equal steps. A rough surface
/// changes most where cos θ is near α, however small α is, so either axis is dense near zero.

/// Below this roughness surfaces are smooth and need no table: its α is kSmoothAlpha.
inline constexpr float kSmoothRoughness = 0.0316228f;
inline constexpr float kSmoothRoughnessRoot = 0.4216965f;  ///< its fourth root

template <typename T>
T fourth_root(T x) {
  return sqrt(safe_sqrt(x));
}

template <typename T>
BasicTablePosition<T> locate_cosine(T cos_theta, int size) {
  return locate(fourth_root(cos_theta), size);
}
template <typename T>
BasicTablePosition<T> locate_roughness(T roughness, int size) {
  return locate((fourth_root(roughness) - kSmoothRoughnessRoot) / (1.0f - kSmoothRoughnessRoot), size);
}

/// cos θ and roughness of node i; the former at least 1e-6, where albedos still have a limit.
inline float albedo_cosine(int i, int size) {
  return std::max(sqr(sqr(static_cast<float>(i) / static_cast<float>(size - 1))), 1e-6f);
}
inline float albedo_roughness(int i, int size) {
  const float root = kSmoothRoughnessRoot +
                     (1.0f - kSmoothRoughnessRoot) * static_cast<float>(i) / static_cast<float>(size - 1);
  return sqr(sqr(root));
}

/// What each node of an axis of cos θ weighs in the cosine-weighted average 2∫ … μ dμ of what is linear
/// between nodes. @param locate TablePosition of cos θ
template <typename Locate>
std::vector<float> cosine_average_weights(const Locate& locate, int size) {
  constexpr int kSteps = 1 << 14;
  std::vector<double> sums(static_cast<std::size_t>(size));
  for (int i = 0; i < kSteps; ++i) {  // μ = x⁴, 2μ dμ = 8x⁷ dx
    const double x = (i + 0.5) / kSteps, x2 = x * x;
    const TablePosition place = locate(static_cast<float>(x2 * x2));
    for (int end = 0; end < 2; ++end)
      sums[static_cast<std::size_t>(place.cell + end)] += place.weight(end) * 8.0 / kSteps * x2 * x2 * x2 * x;
  }
  return {sums.begin(), sums.end()};
}

}  // namespace photopic
