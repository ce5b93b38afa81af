#include "core/lights/light_bounds.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/box.h"

namespace photopic {
namespace {

constexpr int kBuckets = 12;
using Buckets = std::array<LightBounds, kBuckets>;

float component(Vec3f v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
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
  if (a.cos_angle == -1.0f) return a;
  if (b.cos_angle == 1.0f && dot(a.axis, b.axis) >= a.cos_angle) return a;  // without arccosines
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

/// Intensity × area of the box × solid angle of the directions lit.
double cost_of(const LightBounds& b) {
  if (!(b.intensity > 0.0f)) return 0.0;
  const Vec3f d = b.high - b.low;
  const double area = 2.0 * (double{d.x} * d.y + double{d.y} * d.z + double{d.z} * d.x);
  const double diagonal2 = dot(to_double(d), to_double(d));
  const double o = clamped_acos(b.cos_o), e = clamped_acos(b.cos_e);
  const double w = std::min(o + e, std::numbers::pi);
  const double angle =
      2.0 * std::numbers::pi * (1.0 - std::cos(o)) +
      0.5 * std::numbers::pi *
          (2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) - 2.0 * o * std::sin(o) + std::cos(o));
  // A flat or thin box still has an extent: a share of its diagonal too small to count in any other.
  return b.intensity * angle * (area + 1e-3 * diagonal2);
}

LightBounds bounds_of(const std::vector<LightBounds>& lights, std::span<const std::uint32_t> members) {
  LightBounds all;
  for (const std::uint32_t i : members) all = unite(all, lights[i]);
  return all;
}

LightBounds bounds_of(const Buckets& buckets, int begin, int end) {
  LightBounds all;
  for (int i = begin; i < end; ++i) all = unite(all, buckets[static_cast<std::size_t>(i)]);
  return all;
}

/// Buckets along the longest axis of the box about the lights' middles.
class Division {
 public:
  Division(const std::vector<LightBounds>& lights, std::span<const std::uint32_t> members) : lights_(lights) {
    Boxf box;
    for (const std::uint32_t i : members) box.add(lights[i].middle());
    const Vec3f extent = box.high - box.low;
    axis_ = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    from_ = component(box.low, axis_), width_ = component(extent, axis_);
  }

  /// Not where all middles coincide.
  bool possible() const { return width_ > 0.0f; }

  int bucket_of(std::uint32_t light) const {
    const float x = (component(lights_[light].middle(), axis_) - from_) / width_ * kBuckets;
    return std::clamp(static_cast<int>(x), 0, kBuckets - 1);
  }

  Buckets fill(std::span<const std::uint32_t> members) const {
    Buckets buckets{};
    for (const std::uint32_t i : members) {
      LightBounds& b = buckets[static_cast<std::size_t>(bucket_of(i))];
      b = unite(b, lights_[i]);
    }
    return buckets;
  }

 private:
  const std::vector<LightBounds>& lights_;
  int axis_;
  float from_, width_;
};

/// How many buckets go to the first half.
int best_border(const Buckets& buckets) {
  std::array<double, kBuckets> before{};
  LightBounds growing;
  for (std::size_t i = 0; i + 1 < kBuckets; ++i) {
    growing = unite(growing, buckets[i]);
    before[i] = cost_of(growing);
  }
  int best = 0;
  double best_cost = std::numeric_limits<double>::infinity();
  growing = {};
  for (std::size_t i = kBuckets - 1; i > 0; --i) {
    growing = unite(growing, buckets[i]);
    const double total = before[i - 1] + cost_of(growing);
    if (total < best_cost) best_cost = total, best = static_cast<int>(i);
  }
  return best;
}

/// Whether a light shines into a cone of less than 60° about its axis alone.
bool is_beam(const LightBounds& light) {
  const float o = light.cos_o, e = light.cos_e;
  return o > 0.0f && o * e - safe_sqrt(1.0f - sqr(o)) * safe_sqrt(1.0f - sqr(e)) > 0.5f;
}

}  // namespace

LightBounds unite(const LightBounds& a, const LightBounds& b) {
  if (a.intensity == 0.0f) return b;
  if (b.intensity == 0.0f) return a;
  const Cone cone = unite_cones({a.axis, a.cos_o}, {b.axis, b.cos_o});
  return {lower(a.low, b.low),
          upper(a.high, b.high),
          cone.axis,
          cone.cos_angle,
          std::min(a.cos_e, b.cos_e),
          a.intensity + b.intensity,
          a.two_sided || b.two_sided};
}

LightCluster::LightCluster(const std::vector<LightBounds>& lights, std::span<std::uint32_t> its)
    : LightCluster(its, bounds_of(lights, its)) {}

LightCluster::LightCluster(std::span<std::uint32_t> its, const LightBounds& around)
    : members(its), bounds(around), cost(cost_of(around)) {}

std::array<LightCluster, 2> split(const LightCluster& cluster, const std::vector<LightBounds>& lights) {
  const std::span<std::uint32_t> all = cluster.members;
  // With others in their cluster beams would seem to shine everywhere.
  const auto rest =
      std::partition(all.begin(), all.end(), [&](std::uint32_t i) { return is_beam(lights[i]); });
  if (const auto beams = static_cast<std::size_t>(rest - all.begin()); beams > 0 && beams < all.size())
    return {LightCluster(lights, all.first(beams)), LightCluster(lights, all.subspan(beams))};
  if (const Division division(lights, all); division.possible()) {
    const Buckets buckets = division.fill(all);
    const int border = best_border(buckets);
    const auto second = std::partition(all.begin(), all.end(),
                                       [&](std::uint32_t i) { return division.bucket_of(i) < border; });
    const auto count = static_cast<std::size_t>(second - all.begin());
    if (count > 0 && count < all.size())
      return {LightCluster(all.first(count), bounds_of(buckets, 0, border)),
              LightCluster(all.subspan(count), bounds_of(buckets, border, kBuckets))};
  }
  const std::size_t half = all.size() / 2;
  return {LightCluster(lights, all.first(half)), LightCluster(lights, all.subspan(half))};
}

}  // namespace photopic
