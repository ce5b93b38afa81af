#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace photopic {

/// What a light, or a cluster of them, may send where: a box, a cone of normals (half angle θ_o about an
/// axis) and how far each shines beyond its normal (θ_e). Conty Estevez & Kulla 2018, "Importance Sampling of
/// Many Lights with Adaptive Tree Splitting", section 4.
struct LightBounds {
  Vec3f low{}, high{};     ///< corners of the box, relative to Scene::origin [m]
  Vec3f axis{};            ///< unit
  float cos_o = 1.0f;      ///< −1: normals all around
  float cos_e = 0.0f;      ///< of π/2 for surfaces, π for points
  float intensity = 0.0f;  ///< root mean square over all directions, up to a factor common to all
  bool two_sided = false;  ///< shines along −axis too

  Vec3f middle() const { return (low + high) * 0.5f; }
};

/// The smallest that holds both.
LightBounds unite(const LightBounds& a, const LightBounds& b);

/// Lights of a list, by their indices, and what holds them all.
struct LightCluster {
  LightCluster(const std::vector<LightBounds>& lights, std::span<std::uint32_t> its);
  LightCluster(std::span<std::uint32_t> its, const LightBounds& around);

  std::span<std::uint32_t> members;
  LightBounds bounds;
  double cost;  ///< surface area orientation heuristic: the same paper, equation 1
};

/// Two halves of a cluster of two lights or more, none empty: beams and the rest, else those of least cost as
/// far as twelve buckets along the box's longest axis tell. Puts the members in order.
std::array<LightCluster, 2> split(const LightCluster& cluster, const std::vector<LightBounds>& lights);

}  // namespace photopic
