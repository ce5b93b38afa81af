#include "core/lights/light_tree.h"

#include <algorithm>
#include <numeric>

namespace photopic {
namespace {

/// Clusters whose normals lie within 26° and whose radius is below a quarter of the distance are chosen from
/// by intensity alone: more would cost more than it tells.
constexpr float kNarrowCone = 0.9f;
constexpr float kSmall2 = 0.06f;

/// The root's branches are weighed for every choice, so none is opened there that has less than this share
/// of the cost.
constexpr double kLeastCost = 1e-6;

/// Parts of a tree that tell what all of it may send to a place: more would cost more than they tell.
constexpr std::size_t kOverview = 4;

}  // namespace

LightBranch<float> LightTree::Node::branch(std::uint32_t i) const {
  const auto& b = branches;
  const auto k = static_cast<int>(i);
  return {b.intensity[i], lane(b.middle, k), b.radius[i], lane(b.axis, k),
          b.cos_o[i],     b.sin_o[i],        b.cos_e[i],  b.other_side[i]};
}

/// Whether a branch's lights are seen so alike that their intensity alone may choose among them.
bool LightTree::Node::seen_alike(std::uint32_t i, Vec3f from) const {
  const Vec3f to_middle = lane(branches.middle, static_cast<int>(i)) - from;
  return cluster[i] != kNoCluster && sqr(branches.radius[i]) < kSmall2 * dot(to_middle, to_middle);
}

/// Fills nodes from clusters of lights; a stack instead of recursion, for lists as long as they like.
struct LightTree::Build {
  const std::vector<LightBounds>& lights;
  double total_intensity;

  /// Opens the costliest until the node is full, but below the root none that fills a node of its own: full
  /// nodes are few nodes.
  std::vector<LightCluster> branches(const LightCluster& all, bool root, std::size_t width = kWidth) const {
    if (all.members.size() <= width) return singles(all.members);
    std::vector<LightCluster> list{all};
    const auto opens = [&](const LightCluster& c) {
      if (!root) return c.members.size() > kWidth;
      return c.members.size() > 1 && c.cost >= kLeastCost * all.cost;
    };
    const auto cost = [&](const LightCluster& c) { return opens(c) ? c.cost : -1.0; };
    while (list.size() < width) {
      const auto costliest =
          std::max_element(list.begin(), list.end(),
                           [&](const LightCluster& a, const LightCluster& b) { return cost(a) < cost(b); });
      if (!opens(*costliest)) break;
      const auto [first, second] = split(*costliest, lights);
      *costliest = first;
      list.push_back(second);
    }
    return list;
  }

  std::vector<LightCluster> singles(std::span<std::uint32_t> members) const {
    std::vector<LightCluster> list;
    for (std::size_t i = 0; i < members.size(); ++i) list.emplace_back(lights, members.subspan(i, 1));
    return list;
  }

  double intensity(std::span<const std::uint32_t> members) const {
    double sum = 0.0;
    for (const std::uint32_t i : members) sum += double{lights[i].intensity};
    return sum;
  }

  void fill(Node& node, std::uint32_t i, const LightCluster& cluster) const {
    const LightBounds& b = cluster.bounds;
    LightBranch<Lanes>& n = node.branches;
    set_lane(n.middle, static_cast<int>(i), b.middle());
    n.radius[i] = length((b.high - b.low) * 0.5f);
    set_lane(n.axis, static_cast<int>(i), b.axis);
    n.cos_o[i] = b.cos_o, n.sin_o[i] = safe_sqrt(1.0f - sqr(b.cos_o)), n.cos_e[i] = b.cos_e;
    n.intensity[i] = static_cast<float>(intensity(cluster.members) / total_intensity);
    n.other_side[i] = b.two_sided ? -1.0f : 1.0f;
  }

  AliasTable table(std::span<const std::uint32_t> members) const {
    std::vector<double> weights;
    for (const std::uint32_t i : members) weights.push_back(double{lights[i].intensity});
    return AliasTable(weights);
  }
};

LightTree::LightTree(const std::vector<LightBounds>& lights, std::span<const std::uint32_t> names)
    : nodes_(1), place_of_node_{kRoot}, place_of_light_(lights.size()) {
  std::vector<std::uint32_t> order(lights.size());
  std::iota(order.begin(), order.end(), 0u);
  Build build{lights, 0.0};
  build.total_intensity = build.intensity(order);

  struct Pending {
    std::uint32_t node;
    LightCluster cluster;
  };
  const LightCluster all(lights, order);
  for (const LightCluster& part : build.branches(all, true, kOverview)) {
    Node node;
    build.fill(node, 0, part);
    overview_.push_back(node.branch(0));
  }
  std::vector<Pending> pending{{0, all}};
  std::vector<std::span<const std::uint32_t>> alike;
  while (!pending.empty()) {
    const auto [node, cluster] = pending.back();
    pending.pop_back();
    std::uint32_t lane = 0;
    const std::vector<LightCluster> branches = build.branches(cluster, node == 0);
    if (node == 0) root_width_ = static_cast<std::uint32_t>(branches.size());
    for (const LightCluster& branch : branches) {
      const BranchIndex place = node * kWidth + lane;
      build.fill(nodes_[node], lane, branch);
      if (branch.members.size() == 1) {
        nodes_[node].child[lane] = ~static_cast<std::int32_t>(names[branch.members[0]]);
        place_of_light_[branch.members[0]] = place;
      } else {
        if (branch.bounds.cos_o > kNarrowCone) {
          nodes_[node].cluster[lane] = static_cast<std::uint32_t>(alike.size());
          alike.push_back(branch.members);
        }
        const auto child = static_cast<std::uint32_t>(nodes_.size());
        nodes_[node].child[lane] = static_cast<std::int32_t>(child);
        nodes_.emplace_back();
        place_of_node_.push_back(place);
        pending.push_back({child, branch});
      }
      ++lane;
    }
  }

  // Now the order is final.
  for (const auto members : alike)
    clusters_.push_back({build.table(members), static_cast<std::uint32_t>(members.data() - order.data())});
  for (const std::uint32_t i : order) lights_in_order_.push_back(names[i]);
}

float LightTree::probability(const LightReference& at, std::uint32_t light) const {
  // Up to the root, where whatever is chosen within a cluster by intensity begins anew.
  BranchIndex place = place_of_light_[light];
  const float intensity = nodes_[place / kWidth].branches.intensity[place % kWidth];
  float probability = 1.0f;
  while (place != kRoot) {
    const Node& n = nodes_[place / kWidth];
    const BranchIndex above = place_of_node_[place / kWidth];
    const Node& parent = nodes_[above == kRoot ? 0 : above / kWidth];
    if (above != kRoot && parent.seen_alike(above % kWidth, at.position)) {
      probability = intensity / parent.branches.intensity[above % kWidth];
    } else {
      const Lanes weight = importance(n.branches, at);
      float total = 0.0f;
      for (std::uint32_t i = 0; i < kWidth; ++i) total += weight[i];
      probability *= total > 0.0f ? weight[place % kWidth] / total : 0.0f;
    }
    place = above;
  }
  return probability;
}

}  // namespace photopic
