#include <algorithm>

#include "core/lights/light_tree.h"

namespace photopic {

/// Sixteen choices on their way down, level by level, so that none waits for another's look-ups and the
/// processor's vectors serve: at the root, where all are, each branch is weighed for sixteen points; further
/// down, sixteen branches for each point.
class LightTree::Descents {
 public:
  Descents(const LightTree& tree, const BasicLightReference<Lanes>& at, const DoubleLanes& u,
           std::span<const std::uint32_t> wanted, Choices& choices)
      : tree_(tree), at_(at), choices_(choices), u_(u), count_(wanted.size()) {
    std::ranges::copy(wanted, under_way_.begin());
    draw(weigh_root(), tree_.root_width_);
  }

  /// To the branches drawn. @return whether there is more to go
  bool go_on();

  /// Draws branches of the nodes reached.
  void draw() { draw(weigh_nodes(), kWidth); }

  /// Lights of the clusters reached.
  void draw_by_intensity() const;

 private:
  LaneMatrix weigh_root() const;
  LaneMatrix weigh_nodes() const;
  void draw(const LaneMatrix& weight_of_branch, std::uint32_t branches);

  const LightTree& tree_;
  const BasicLightReference<Lanes>& at_;
  Choices& choices_;

  DoubleLanes u_;
  Lanes probability_ = Lanes{} + 1.0f;
  IntLanes branch_;  ///< drawn, where the probability is above 0

  std::array<std::uint32_t, kLanes> node_{};
  std::array<std::uint32_t, kLanes> under_way_;  ///< lanes, the first count_
  std::size_t count_;

  struct AtCluster {
    std::uint32_t lane;
    const Cluster* cluster;
    double u;
  };
  std::array<AtCluster, kLanes> at_clusters_;
  std::size_t cluster_count_ = 0;
};

LaneMatrix LightTree::Descents::weigh_root() const {
  LaneMatrix weight;
  for (std::uint32_t i = 0; i < tree_.root_width_; ++i)
    weight[i] = importance(tree_.nodes_[0].branch(i), at_);
  return weight;
}

LaneMatrix LightTree::Descents::weigh_nodes() const {
  LaneMatrix weight{};
  for (std::size_t j = 0; j < count_; ++j) {
    const std::uint32_t k = under_way_[j];
    const auto i = static_cast<int>(k);
    const LightReference at{lane(at_.position, i), lane(at_.normal, i)};
    weight[k] = importance(tree_.nodes_[node_[k]].branches, at);
  }
  return transpose(weight);
}

void LightTree::Descents::draw(const LaneMatrix& weight, std::uint32_t branches) {
  LaneMatrix up_to;
  Lanes total{};
  for (std::size_t i = 0; i < branches; ++i) up_to[i] = total += weight[i];

  // The first whose sum lies above: sums never fall, so that it has a weight.
  const DoubleLanes target = u_ * to_double(total);
  const Lanes below_total = total * (1.0f - 0x1p-24f), rounded = min(to_float(target), below_total);
  branch_ = IntLanes{};
  Lanes passed{}, share{};
  for (std::size_t i = branches; i-- > 0;) share = select(up_to[i] > rounded, weight[i], share);
  for (std::size_t i = 0; i < branches; ++i) {
    const IntLanes below = up_to[i] <= rounded;
    branch_ -= below;
    passed = select(below, up_to[i], passed);
  }
  probability_ *= share / total;

  const DoubleLanes rest = (target - to_double(passed)) / to_double(share);
  const DoubleLanes least{}, most = least + (1.0 - 0x1p-53);
  u_ = rest > least ? (rest < most ? rest : most) : least;
}

bool LightTree::Descents::go_on() {
  std::size_t still = 0;
  for (std::size_t j = 0; j < count_; ++j) {
    const std::uint32_t k = under_way_[j];
    choices_[k] = {kNoLight, 0.0f};
    if (!(probability_[k] > 0.0f)) continue;  // 0/0 where nothing shines
    const Node& node = tree_.nodes_[node_[k]];
    const auto branch = static_cast<std::uint32_t>(branch_[k]);
    const std::int32_t child = node.child[branch];
    choices_[k] = {static_cast<std::uint32_t>(~child), probability_[k]};
    if (child < 0) continue;
    if (node.seen_alike(branch, lane(at_.position, static_cast<int>(k)))) {
      const Cluster& cluster = tree_.clusters_[node.cluster[branch]];
      cluster.by_intensity.prefetch(u_[k]);
      at_clusters_[cluster_count_++] = {k, &cluster, u_[k]};
      continue;
    }
    node_[k] = static_cast<std::uint32_t>(child);
    under_way_[still++] = k;
    const auto* lines = reinterpret_cast<const char*>(&tree_.nodes_[node_[k]]);
    for (std::size_t i = 0; i < sizeof(Node); i += sizeof(Lanes)) __builtin_prefetch(lines + i);
  }
  count_ = still;
  return count_ > 0;
}

void LightTree::Descents::draw_by_intensity() const {
  for (std::size_t j = 0; j < cluster_count_; ++j) {
    auto [k, cluster, u] = at_clusters_[j];
    const std::uint32_t i = cluster->by_intensity.sample(u);
    choices_[k].light = tree_.lights_in_order_[cluster->first + i];
    choices_[k].probability *= cluster->by_intensity.probability(i);
  }
}

Lanes LightTree::total_importance(const BasicLightReference<Lanes>& at) const {
  Lanes total{};
  for (const LightBranch<float>& part : overview_) total += importance(part, at);
  return total;
}

void LightTree::choose(const BasicLightReference<Lanes>& at, const DoubleLanes& u,
                       std::span<const std::uint32_t> wanted, Choices& choices) const {
  Descents descents(*this, at, u, wanted, choices);
  while (descents.go_on()) descents.draw();
  descents.draw_by_intensity();
}

}  // namespace photopic
