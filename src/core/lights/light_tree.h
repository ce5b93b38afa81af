#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/lights/light.h"
#include "core/lights/light_bounds.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

/// A tree over lights near and far, descended at random in proportion to what each branch may contribute at
/// the place that is lit: Conty Estevez & Kulla 2018. Sixteen branches a node, weighed together in the
/// processor's vectors.
class LightTree {
 public:
  LightTree() = default;
  /// @param lights of power > 0, at least one
  /// @param names what choose() calls them; by default their indices
  explicit LightTree(const std::vector<LightBounds>& lights, std::span<const std::uint32_t> names = {});

  bool empty() const { return nodes_.empty(); }

  struct Choice {
    std::uint32_t light;  ///< its name; kNoLight where none shines
    float probability;
  };
  /// @param u in [0, 1)
  Choice choose(const LightReference& at, double u) const;

  /// The probability that choose() gives this light. @param light index into the constructor's list
  float probability(const LightReference& at, std::uint32_t light) const;

 private:
  static constexpr std::uint32_t kWidth = kLanes;

  /// What is known of each branch, a line of memory a quantity; branches that are missing have no power.
  struct alignas(64) Node {
    Lanes power;                             ///< of all lights: 1
    std::array<std::int32_t, kWidth> child;  ///< a node, or ~light
    Lanes x, y, z, radius;                   ///< sphere about the box [m]
    Lanes axis_x, axis_y, axis_z, cos_o, sin_o, cos_e;
    Lanes other_side;  ///< −1: shines along −axis too; else 1

    Lanes importance(const LightReference& at) const;
    bool seen_alike(std::uint32_t lane, Vec3f from) const;
  };
  struct Build;

  /// A node's lane, node · kWidth + lane.
  using Place = std::uint32_t;
  static constexpr Place kRoot = ~0u;

  std::vector<Node> nodes_;
  std::vector<Place> place_of_node_;  ///< in its parent
  std::vector<Place> place_of_light_;
};

}  // namespace photopic
