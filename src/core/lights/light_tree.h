#pragma once

#include <cstdint>
#include <vector>

#include "core/lights/light.h"

namespace photopic {

/// What a light, or a cluster of them, may send where: a box, a cone of normals (half angle θ_o about an
/// axis) and how far each shines beyond its normal (θ_e). Conty Estevez & Kulla 2018, section 4.
struct LightBounds {
  Vec3f low{}, high{};
  Vec3f axis{};            ///< unit
  float cos_o = 1.0f;      ///< −1: normals all around
  float cos_e = 0.0f;      ///< of π/2 for surfaces, π for points
  float power = 0.0f;      ///< luminous intensity along the axis, up to a factor common to all
  bool two_sided = false;  ///< shines along −axis too

  Vec3f middle() const { return (low + high) * 0.5f; }
};

/// The smallest that holds both.
LightBounds unite(const LightBounds& a, const LightBounds& b);

/// A binary tree over lights near and far, descended at random in proportion to what each half may contribute
/// at the place that is lit: Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive
/// Tree Splitting".
class LightTree {
 public:
  LightTree() = default;
  /// @param lights of power > 0, at least one
  explicit LightTree(const std::vector<LightBounds>& lights);

  bool empty() const { return nodes_.empty(); }

  struct Choice {
    std::uint32_t light;  ///< index into the constructor's list; kNoLight where none shines
    float probability;
  };
  /// @param u in [0, 1)
  Choice choose(const LightReference& at, double u) const;

  /// The probability that choose() gives this light.
  float probability(const LightReference& at, std::uint32_t light) const;

 private:
  /// Children stand side by side.
  struct Node {
    Vec3f middle;
    float radius;  ///< of the sphere about the box
    Vec3f axis;
    float cos_o, sin_o, cos_e, power;
    bool two_sided, leaf;
    std::uint32_t child;  ///< the first of two
    std::uint32_t parent;
    std::uint32_t begin, end;  ///< its lights, in order_

    float importance(const LightReference& at) const;

    /// Whether its lights are seen so alike that their power alone may choose among them.
    bool compact(Vec3f from) const;
  };
  struct Build;

  void fill(std::uint32_t node, const LightBounds& bounds);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;     ///< lights, each node's side by side
  std::vector<double> power_before_;     ///< of the lights before each in that order, and of all
  std::vector<std::uint32_t> place_of_;  ///< of each light in that order
  std::vector<std::uint32_t> leaf_of_;   ///< of each light, its node
};

}  // namespace photopic
