#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lights/alias_table.h"
#include "core/lights/light_importance.h"

namespace photopic {

/// A tree over lights near and far, descended at random in proportion to what each branch may contribute at
/// the place that is lit: Conty Estevez & Kulla 2018. Sixteen branches a node, weighed together in the
/// processor's vectors.
class LightTree {
 public:
  LightTree() = default;
  /// @param lights of intensity > 0, at least one
  /// @param names what choose() calls them
  LightTree(const std::vector<LightBounds>& lights, std::span<const std::uint32_t> names);

  bool empty() const { return nodes_.empty(); }

  struct Choice {
    std::uint32_t light;  ///< its name; kNoLight where none shines
    float probability;
  };
  using Choices = std::array<Choice, kLanes>;

  /// What all lights may send to each point, at most and roughly: importance().
  Lanes total_importance(const BasicLightReference<Lanes>& at) const;

  /// For several points at once. @param u in [0, 1) @param wanted lanes, of which the choices are filled in
  void choose(const BasicLightReference<Lanes>& at, const DoubleLanes& u,
              std::span<const std::uint32_t> wanted, Choices& choices) const;

  /// The probability that choose() gives this light. @param light index into the constructor's list
  float probability(const LightReference& at, std::uint32_t light) const;

 private:
  static constexpr std::uint32_t kWidth = kLanes;
  static constexpr std::uint32_t kNoCluster = ~0u;

  /// Branches that are missing have no intensity.
  struct Node {
    LightBranch<Lanes> branches{};
    IntLanes child{};  ///< a node, or ~light
    UintLanes cluster =
        UintLanes{} + kNoCluster;  ///< of lights so alike that intensity may choose among them

    LightBranch<float> branch(std::uint32_t lane) const;
    bool seen_alike(std::uint32_t lane, Vec3f from) const;
  };
  /// A branch's lights, to be chosen by intensity.
  struct Cluster {
    AliasTable by_intensity;
    std::uint32_t first;  ///< in lights_in_order_
  };
  struct Build;
  class Descents;

  /// A node's lane, node · kWidth + lane.
  using BranchIndex = std::uint32_t;
  static constexpr BranchIndex kRoot = ~0u;

  std::vector<Node> nodes_;
  std::uint32_t root_width_ = 0;              ///< how many branches the first has
  std::vector<LightBranch<float>> overview_;  ///< of all lights in a few parts
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> lights_in_order_;  ///< their names, so that each branch's stand together
  std::vector<BranchIndex> place_of_node_;      ///< in its parent
  std::vector<BranchIndex> place_of_light_;
};

}  // namespace photopic
