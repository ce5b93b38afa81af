#include "core/lights/light_tree.h"

#include <algorithm>
#include <numeric>

namespace photopic {
namespace {

/// Clusters whose normals lie within 26° and whose radius is below a quarter of the distance are chosen from
/// by power alone: more would cost more than it tells.
constexpr float kNarrowCone = 0.9f;
constexpr float kSmall2 = 0.06f;

/// Squared distance [m²] that keeps importances finite.
constexpr float kLeastDistance2 = 1e-30f;

/// The second where the numbers cannot be compared.
Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}

/// The largest number below x > 0 that 24 bits tell from it.
float just_below(float x) {
  return x * (1.0f - 0x1p-24f);
}

}  // namespace

/// What may arrive from each at most, roughly: power / distance² × the cosines at both ends, each at its most
/// favourable within the sphere about the box. Where the sphere lies below the surface's plane, nothing.
Lanes LightTree::Node::importance(const LightReference& at) const {
  // Within the sphere its radius is the distance.
  const Lanes dx = x - at.position.x, dy = y - at.position.y, dz = z - at.position.z;
  const Lanes to_middle2 = dx * dx + dy * dy + dz * dz, radius2 = radius * radius;
  const auto inside = to_middle2 <= radius2;
  const Lanes inverse = 1.0f / sqrt(larger(larger(to_middle2, radius2), kLeastDistance2 + Lanes{}));
  const Lanes sin_b = radius * inverse;  // half the angle that the sphere subtends

  const Vec3f n = at.normal;
  const Lanes height = (n.x * dx + n.y * dy + n.z * dz) * inverse + sin_b + (n == Vec3f{} ? 1.0f : 0.0f);
  const Lanes cos_surface = larger(height < 1.0f ? height : 1.0f + Lanes{}, Lanes{});

  // At the light: the angle to the axis, less the cone's and the sphere's.
  const Lanes along = -(axis_x * dx + axis_y * dy + axis_z * dz) * inverse;
  const Lanes cos_w = larger(along, along * other_side), sin_w = sqrt(larger(1.0f - cos_w * cos_w, Lanes{}));
  const auto in_cone = cos_w >= cos_o;
  const Lanes cos_x = in_cone ? 1.0f + Lanes{} : cos_w * cos_o + sin_w * sin_o;
  const Lanes sin_x = in_cone ? Lanes{} : sin_w * cos_o - cos_w * sin_o;
  const Lanes cos_b = sqrt(larger(1.0f - sin_b * sin_b, Lanes{}));
  const Lanes cos_light = inside || cos_x >= cos_b ? 1.0f + Lanes{} : cos_x * cos_b + sin_x * sin_b;
  const Lanes shines = cos_light > cos_e ? larger(cos_light, Lanes{}) : Lanes{};
  return power * cos_surface * shines * (inverse * inverse);
}

/// Whether a branch's lights are seen so alike that their power alone may choose among them.
bool LightTree::Node::seen_alike(std::uint32_t i, Vec3f from) const {
  const Vec3f to_middle = Vec3f{x[i], y[i], z[i]} - from;
  return cos_o[i] > kNarrowCone && sqr(radius[i]) < kSmall2 * dot(to_middle, to_middle);
}

/// Fills nodes from clusters of lights; a stack instead of recursion, for lists as long as they like.
struct LightTree::Build {
  const std::vector<LightBounds>& lights;
  double total_power;

  /// Opens the costliest until the node is full, but below the root none that fills a node of its own: full
  /// nodes are few nodes.
  std::vector<LightCluster> branches(const LightCluster& all, bool root) const {
    std::vector<LightCluster> list{all};
    const std::size_t whole = root || all.members.size() <= kWidth ? 1 : kWidth;
    const auto cost = [whole](const LightCluster& c) { return c.members.size() > whole ? c.cost : -1.0; };
    while (list.size() < kWidth) {
      const auto costliest =
          std::max_element(list.begin(), list.end(),
                           [&](const LightCluster& a, const LightCluster& b) { return cost(a) < cost(b); });
      if (costliest->members.size() <= whole) break;
      const auto [first, second] = split(*costliest, lights);
      *costliest = first;
      list.push_back(second);
    }
    return list;
  }

  void fill(Node& n, std::uint32_t i, const LightBounds& b) const {
    const Vec3f middle = b.middle();
    n.x[i] = middle.x, n.y[i] = middle.y, n.z[i] = middle.z;
    n.radius[i] = length((b.high - b.low) * 0.5f);
    n.axis_x[i] = b.axis.x, n.axis_y[i] = b.axis.y, n.axis_z[i] = b.axis.z;
    n.cos_o[i] = b.cos_o, n.sin_o[i] = safe_sqrt(1.0f - sqr(b.cos_o)), n.cos_e[i] = b.cos_e;
    n.power[i] = static_cast<float>(b.power / total_power);
    n.other_side[i] = b.two_sided ? -1.0f : 1.0f;
  }
};

LightTree::LightTree(const std::vector<LightBounds>& lights, std::span<const std::uint32_t> names)
    : nodes_(1), place_of_node_{kRoot}, place_of_light_(lights.size()) {
  Build build{lights, 0.0};
  for (const LightBounds& light : lights) build.total_power += double{light.power};
  std::vector<std::uint32_t> order(lights.size());
  std::iota(order.begin(), order.end(), 0u);

  struct Pending {
    std::uint32_t node;
    LightCluster cluster;
  };
  std::vector<Pending> pending{{0, LightCluster(lights, order)}};
  while (!pending.empty()) {
    const auto [node, cluster] = pending.back();
    pending.pop_back();
    std::uint32_t lane = 0;
    for (const LightCluster& branch : build.branches(cluster, node == 0)) {
      const Place place = node * kWidth + lane;
      build.fill(nodes_[node], lane, branch.bounds);
      if (branch.members.size() == 1) {
        nodes_[node].child[lane] =
            ~static_cast<std::int32_t>(names.empty() ? branch.members[0] : names[branch.members[0]]);
        place_of_light_[branch.members[0]] = place;
      } else {
        const auto child = static_cast<std::uint32_t>(nodes_.size());
        nodes_[node].child[lane] = static_cast<std::int32_t>(child);
        nodes_.emplace_back();
        place_of_node_.push_back(place);
        pending.push_back({child, branch});
      }
      ++lane;
    }
  }
}

LightTree::Choice LightTree::choose(const LightReference& at, double u) const {
  float probability = 1.0f;
  bool by_power = false;
  std::uint32_t node = 0;
  while (true) {
    const Node& n = nodes_[node];
    const Lanes weight = by_power ? n.power : n.importance(at);
    Lanes up_to;
    float total = 0.0f;
    for (std::uint32_t i = 0; i < kWidth; ++i) up_to[i] = total += weight[i];
    if (!(total > 0.0f)) return {kNoLight, 0.0f};

    // The first whose sum lies above: sums never fall, so that it has a weight.
    const double target = u * double{total};
    const float rounded = std::min(static_cast<float>(target), just_below(total));
    std::uint32_t lane = 0;
    for (std::uint32_t i = 0; i < kWidth; ++i) lane += up_to[i] <= rounded ? 1u : 0u;
    const double passed = up_to[lane] - weight[lane];
    u = std::clamp((target - passed) / double{weight[lane]}, 0.0, 1.0 - 0x1p-53);
    probability *= weight[lane] / total;

    const std::int32_t child = n.child[lane];
    if (child < 0) return {static_cast<std::uint32_t>(~child), probability};
    by_power = by_power || n.seen_alike(lane, at.position);
    node = static_cast<std::uint32_t>(child);
  }
}

float LightTree::probability(const LightReference& at, std::uint32_t light) const {
  // Up to the root, where whatever is chosen within a cluster by power begins anew.
  Place place = place_of_light_[light];
  const float power = nodes_[place / kWidth].power[place % kWidth];
  float probability = 1.0f;
  while (place != kRoot) {
    const Node& n = nodes_[place / kWidth];
    const Place above = place_of_node_[place / kWidth];
    const Node& parent = nodes_[above == kRoot ? 0 : above / kWidth];
    if (above != kRoot && parent.seen_alike(above % kWidth, at.position)) {
      probability = power / parent.power[above % kWidth];
    } else {
      const Lanes weight = n.importance(at);
      float total = 0.0f;
      for (std::uint32_t i = 0; i < kWidth; ++i) total += weight[i];
      probability *= total > 0.0f ? weight[place % kWidth] / total : 0.0f;
    }
    place = above;
  }
  return probability;
}

}  // namespace photopic
