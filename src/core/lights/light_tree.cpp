#include "core/lights/light_tree.h"

#include <array>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

namespace photopic {
namespace {

constexpr int kBuckets = 12;

/// Clusters whose normals lie within 26° and whose radius is below a quarter of the distance are not divided
/// on the way down: it would cost more than it tells.
constexpr float kNarrowCone = 0.9f;
constexpr float kSmall2 = 0.06f;

float component(Vec3f v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec3f lower(Vec3f a, Vec3f b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3f upper(Vec3f a, Vec3f b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

float clamped_acos(float x) {
  return std::acos(std::clamp(x, -1.0f, 1.0f));
}

struct Cone {
  Vec3f axis;
  float cos_angle;
};

/// The smallest cone about two: Conty Estevez & Kulla 2018, algorithm 1.
Cone unite_cones(Cone a, Cone b) {
  if (a.cos_angle > b.cos_angle) std::swap(a, b);
  const float angle_a = clamped_acos(a.cos_angle), angle_b = clamped_acos(b.cos_angle);
  const float between = clamped_acos(dot(a.axis, b.axis));
  if (between + angle_b <= angle_a) return a;
  const float angle = 0.5f * (angle_a + between + angle_b);
  const Vec3f across = b.axis - a.axis * dot(a.axis, b.axis);
  const float across2 = dot(across, across);
  if (angle >= kPi || !(across2 > 1e-12f)) return {a.axis, -1.0f};
  const float turn = angle - angle_a;
  const Vec3f axis = a.axis * std::cos(turn) + across * (std::sin(turn) / std::sqrt(across2));
  return {normalize(axis), std::cos(angle)};
}

/// Surface area orientation heuristic: power × area of the box × solid angle of the directions lit
/// (Conty Estevez & Kulla 2018, equation 1).
double cost(const LightBounds& b) {
  const Vec3f d = b.high - b.low;
  const double area = 2.0 * (double{d.x} * d.y + double{d.y} * d.z + double{d.z} * d.x);
  const double diagonal2 = dot(to_double(d), to_double(d));
  const double o = clamped_acos(b.cos_o), e = clamped_acos(b.cos_e);
  const double w = std::min(o + e, std::numbers::pi);
  const double angle =
      2.0 * std::numbers::pi * (1.0 - std::cos(o)) +
      0.5 * std::numbers::pi *
          (2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) - 2.0 * o * std::sin(o) + std::cos(o));
  // A flat or thin box still has an extent.
  return b.power * angle * (area + 1e-3 * diagonal2);
}

/// cos max(a − b, 0) of two angles in [0, π].
float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

}  // namespace

LightBounds unite(const LightBounds& a, const LightBounds& b) {
  if (a.power == 0.0f) return b;
  if (b.power == 0.0f) return a;
  const Cone cone = unite_cones({a.axis, a.cos_o}, {b.axis, b.cos_o});
  return {
      lower(a.low, b.low), upper(a.high, b.high),     cone.axis, cone.cos_angle, std::min(a.cos_e, b.cos_e),
      a.power + b.power,   a.two_sided || b.two_sided};
}

/// What may arrive at most, roughly: power / distance² × the cosines at both ends, each at its most
/// favourable within the sphere about the box.
float LightTree::Node::importance(const LightReference& at) const {
  const Vec3f to_point = at.position - middle;
  const float distance2 = std::max(dot(to_point, to_point), 1e-30f);
  const float inverse = 1.0f / std::sqrt(distance2);

  // The angle that the sphere subtends: all around from inside.
  const float ratio = radius * inverse;
  const bool inside = ratio >= 1.0f;
  const float sin_b = inside ? 0.0f : ratio, cos_b = inside ? -1.0f : std::sqrt(1.0f - sqr(ratio));

  // At the surface that is lit.
  float cos_surface = 1.0f;
  if (const float cos_i = -dot(at.normal, to_point) * inverse; cos_i != 0.0f || at.normal != Vec3f{}) {
    cos_surface = cos_of_difference(safe_sqrt(1.0f - sqr(cos_i)), cos_i, sin_b, cos_b);
    if (!(cos_surface > 0.0f)) return 0.0f;
  }

  // At the light: the angle to the axis, less the cone's and the sphere's.
  float cos_w = dot(axis, to_point) * inverse;
  if (two_sided) cos_w = std::abs(cos_w);
  const float sin_w = safe_sqrt(1.0f - sqr(cos_w));
  const float cos_x = cos_of_difference(sin_w, cos_w, sin_o, cos_o);
  const float sin_x = sin_of_difference(sin_w, cos_w, sin_o, cos_o);
  const float cos_light = cos_of_difference(sin_x, cos_x, sin_b, cos_b);
  if (!(cos_light > cos_e)) return 0.0f;
  return power * cos_surface * std::max(cos_light, 0.0f) * sqr(inverse * std::min(1.0f / ratio, 1.0f));
}

bool LightTree::Node::compact(Vec3f from) const {
  if (leaf) return true;
  const Vec3f to_point = from - middle;
  return cos_o > kNarrowCone && sqr(radius) < kSmall2 * dot(to_point, to_point);
}

/// Splits lists of lights in two until each holds one; a stack instead of recursion, for lists as long as
/// they like.
struct LightTree::Build {
  const std::vector<LightBounds>& lights;

  LightBounds bounds_of(std::span<const std::uint32_t> list) const {
    LightBounds all;
    for (const std::uint32_t i : list) all = unite(all, lights[i]);
    return all;
  }

  /// How many lights go to the first half; they stand first then.
  std::size_t split(std::span<std::uint32_t> list) const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Vec3f low{kInfinity, kInfinity, kInfinity}, high = -low;
    for (const std::uint32_t i : list) {
      low = lower(low, lights[i].middle());
      high = upper(high, lights[i].middle());
    }
    const Vec3f extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const float from = component(low, axis), width = component(extent, axis);
    if (!(width > 0.0f)) return list.size() / 2;

    const auto bucket_of = [&](std::uint32_t i) {
      const float x = (component(lights[i].middle(), axis) - from) / width * kBuckets;
      return std::clamp(static_cast<int>(x), 0, kBuckets - 1);
    };
    std::array<LightBounds, kBuckets> buckets{};
    for (const std::uint32_t i : list) {
      LightBounds& b = buckets[static_cast<std::size_t>(bucket_of(i))];
      b = unite(b, lights[i]);
    }
    std::array<double, kBuckets> before{};
    LightBounds growing;
    for (std::size_t i = 0; i + 1 < kBuckets; ++i) {
      growing = unite(growing, buckets[i]);
      before[i] = growing.power > 0.0f ? cost(growing) : 0.0;
    }
    int best = 0;
    double best_cost = std::numeric_limits<double>::infinity();
    growing = {};
    for (int i = kBuckets - 1; i > 0; --i) {
      growing = unite(growing, buckets[static_cast<std::size_t>(i)]);
      const double total =
          before[static_cast<std::size_t>(i - 1)] + (growing.power > 0.0f ? cost(growing) : 0.0);
      if (total < best_cost) best_cost = total, best = i;
    }
    const auto second =
        std::partition(list.begin(), list.end(), [&](std::uint32_t i) { return bucket_of(i) < best; });
    const auto count = static_cast<std::size_t>(second - list.begin());
    return count == 0 || count == list.size() ? list.size() / 2 : count;
  }
};

void LightTree::fill(std::uint32_t node, const LightBounds& b) {
  const Vec3f half = (b.high - b.low) * 0.5f;
  Node& n = nodes_[node];
  n.middle = b.middle(), n.radius = length(half);
  n.axis = b.axis, n.cos_o = b.cos_o, n.sin_o = safe_sqrt(1.0f - sqr(b.cos_o)), n.cos_e = b.cos_e;
  n.power = b.power, n.two_sided = b.two_sided;
}

LightTree::LightTree(const std::vector<LightBounds>& lights)
    : order_(lights.size()),
      power_before_(lights.size() + 1),
      place_of_(lights.size()),
      leaf_of_(lights.size()) {
  const Build build{lights};
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(2 * lights.size());
  nodes_.push_back({});
  nodes_[0].end = static_cast<std::uint32_t>(lights.size());
  std::vector<std::uint32_t> pending{0};
  while (!pending.empty()) {
    const std::uint32_t node = pending.back();
    pending.pop_back();
    const std::uint32_t begin = nodes_[node].begin, end = nodes_[node].end;
    const auto list = std::span(order_).subspan(begin, end - begin);
    fill(node, build.bounds_of(list));
    nodes_[node].leaf = list.size() == 1;
    if (list.size() == 1) {
      leaf_of_[list[0]] = node;
      continue;
    }
    const auto middle = begin + static_cast<std::uint32_t>(build.split(list));
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].child = child;
    nodes_.resize(nodes_.size() + 2);
    nodes_[child].begin = begin, nodes_[child].end = middle;
    nodes_[child + 1].begin = middle, nodes_[child + 1].end = end;
    nodes_[child].parent = nodes_[child + 1].parent = node;
    pending.push_back(child);
    pending.push_back(child + 1);
  }
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    place_of_[order_[i]] = i;
    power_before_[i + 1] = power_before_[i] + double{lights[order_[i]].power};
  }
}

LightTree::Choice LightTree::choose(const LightReference& at, double u) const {
  // Down to a cluster of lights that are seen alike.
  double probability = 1.0;
  const Node* node = nodes_.data();
  while (!node->compact(at.position)) {
    const Node* children = &nodes_[node->child];
    const double a = children[0].importance(at), b = children[1].importance(at), share = a / (a + b);
    if (!(a + b > 0.0)) return {kNoLight, 0.0f};
    const bool second = u >= share;
    u = std::min(second ? (u - share) / (1.0 - share) : u / share, 1.0 - 0x1p-53);
    probability *= second ? 1.0 - share : share;
    node = &children[second ? 1 : 0];
  }

  // One of them, by power.
  const auto first = power_before_.begin() + node->begin, last = power_before_.begin() + node->end;
  const double power = *last - *first;
  const auto above = std::upper_bound(first + 1, last, *first + u * power);
  const auto place = static_cast<std::size_t>(above - power_before_.begin()) - 1;
  probability *= (power_before_[place + 1] - power_before_[place]) / power;
  return {order_[place], static_cast<float>(probability)};
}

float LightTree::probability(const LightReference& at, std::uint32_t light) const {
  // Up to the root, where whatever is chosen within a cluster by power begins anew.
  const std::uint32_t place = place_of_[light];
  const double power = power_before_[place + 1] - power_before_[place];
  double probability = 1.0;
  for (std::uint32_t i = leaf_of_[light]; i != 0;) {
    const std::uint32_t parent = nodes_[i].parent;
    const Node& above = nodes_[parent];
    if (above.compact(at.position)) {
      probability = power / (power_before_[above.end] - power_before_[above.begin]);
    } else {
      const double a = nodes_[above.child].importance(at), b = nodes_[above.child + 1].importance(at);
      const double share = (i == above.child ? a : b) / (a + b);
      probability *= share > 0.0 ? share : 0.0;
    }
    i = parent;
  }
  return static_cast<float>(probability);
}

}  // namespace photopic
