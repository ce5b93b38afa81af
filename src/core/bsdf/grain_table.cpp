#include "core/bsdf/grain_table.h"

#include <cstring>

#include "core/bsdf/albedo_axes.h"

namespace photopic {
namespace {

constexpr float kLeastRoot = 0.25118864f;  // of kSmoothAlpha

float root_of(float alpha) {
  return std::pow(alpha, 0.2f);
}
float alpha_of(float root) {
  return sqr(sqr(root)) * root;
}

/// Where x stands between low and high; 0 where they are one.
float share(float x, float low, float high) {
  return high > low ? (x - low) / (high - low) : 0.0f;
}
float between(float low, float high, int i, int size) {
  return low + (high - low) * static_cast<float>(i) / static_cast<float>(size - 1);
}

float alpha_seen(Vec3f w, const AnisotropicGgx& ggx) {
  const float across = sqr(w.x) + sqr(w.y);
  if (across == 0.0f) return ggx.alpha_y;
  return std::sqrt((sqr(w.x * ggx.alpha_x) + sqr(w.y * ggx.alpha_y)) / across);
}
Vec3f direction_that_sees(float alpha, float z, const AnisotropicGgx& ggx) {
  const float cos2 = std::clamp(share(sqr(alpha), sqr(ggx.alpha_y), sqr(ggx.alpha_x)), 0.0f, 1.0f);
  const float r = safe_sqrt(1.0f - sqr(z));
  return {r * std::sqrt(cos2), r * std::sqrt(1.0f - cos2), z};
}

/// The axis of cos θ seen with an α: by √(cos θ / ½α) near the horizon, by that one's logarithm above, and
/// where the normal is near by the angle to it.
class CosineAxis {
 public:
  explicit CosineAxis(float alpha)
      : half_(0.5f * alpha), root_(std::sqrt(half_)), span_(std::log(1.0f + 1.0f / root_)) {}

  TablePosition locate(float z) const {
    const float t = std::log(1.0f + std::sqrt(z) / root_) / span_;
    return photopic::locate(1.0f - safe_sqrt(1.0f - t), GrainTable::kCosines);
  }
  float node(int i) const {
    const float t = 1.0f - sqr(1.0f - between(0.0f, 1.0f, i, GrainTable::kCosines));
    return std::clamp(sqr(root_ * std::expm1(t * span_)), 1e-6f, 1.0f);
  }
  /// What cosines between viewer and normals are compared with: alike where z / α is.
  float scale(float z) const { return z + half_; }

 private:
  float half_, root_, span_;
};

using Numbers [[gnu::vector_size(kLanes * sizeof(char16_t))]] = std::uint16_t;
/// Numbers are fourth roots: of cosines, over as many times the axis's scale, which none exceeds.
constexpr float kUnit = 65535.0f, kGreatest = 2.0f / kSmoothAlpha;

Lanes decoded(const char16_t* numbers) {
  Numbers loaded;
  std::memcpy(&loaded, numbers, sizeof loaded);
  const Lanes root =
                  __builtin_convertvector(__builtin_convertvector(loaded, IntLanes), Lanes) * (1.0f / kUnit),
              square = root * root;
  return square * square;
}

}  // namespace

GrainTable::SurfacePlace::SurfacePlace(const AnisotropicGgx& g)
    : ggx(g), root_x(root_of(g.alpha_x)), root_y(root_of(g.alpha_y)) {}

TablePosition GrainTable::SurfacePlace::roughness(int size) const {
  return locate(share(root_y, kLeastRoot, 1.0f), size);
}
TablePosition GrainTable::SurfacePlace::grain(int size) const {
  return locate(share(root_x, root_y, 1.0f), size);
}

AnisotropicGgx GrainTable::ggx_at(int roughness, int roughnesses, int grain, int grains) {
  const float root = between(kLeastRoot, 1.0f, roughness, roughnesses);
  return {alpha_of(between(root, 1.0f, grain, grains)), alpha_of(root)};
}

std::array<char16_t, kLanes> GrainTable::integrate(int node, const VisibleNormals& normals) {
  const int c = node % kCosines, a = node / kCosines % kAzimuths, g = node / kCosines / kAzimuths % kGrains;
  const SurfacePlace s(ggx_at(node / kCosines / kAzimuths / kGrains, kRoughnesses, g, kGrains));
  const float alpha = alpha_of(between(s.root_y, s.root_x, a, kAzimuths));
  const CosineAxis axis(alpha);
  const float z = axis.node(c);
  const Lanes q = BounceCosines::of(normals.bounces(s.ggx, direction_that_sees(alpha, z, s.ggx))).values;
  const float unit = kGreatest * axis.scale(z);
  std::array<char16_t, kLanes> numbers{};
  for (int i = 0; i < kLanes; ++i) {
    const float x = i == BounceCosines::kMissing ? q[i] : q[i] / unit;
    numbers[static_cast<std::size_t>(i)] = static_cast<char16_t>(std::lround(kUnit * fourth_root(x)));
  }
  return numbers;
}

BounceCosines GrainTable::look_up(const SurfacePlace& s, Vec3f w) const {
  const float alpha = alpha_seen(w, s.ggx);
  const CosineAxis axis(alpha);
  const TablePosition r = s.roughness(kRoughnesses), g = s.grain(kGrains), c = axis.locate(w.z),
                      a = locate(share(root_of(alpha), s.root_y, s.root_x), kAzimuths);
  Lanes sum{};
  for (int corner = 0; corner < 4; ++corner) {
    const int dr = corner / 2, dg = corner % 2;
    const int row = ((r.cell + dr) * kGrains + g.cell + dg) * kAzimuths + a.cell;
    const char16_t *near = numbers_ + (row * kCosines + c.cell) * kLanes, *far = near + kCosines * kLanes;
    const Lanes low = (1.0f - c.t) * decoded(near) + c.t * decoded(near + kLanes),
                high = (1.0f - c.t) * decoded(far) + c.t * decoded(far + kLanes);
    const float rough = dr == 0 ? 1.0f - r.t : r.t, grained = dg == 0 ? 1.0f - g.t : g.t;
    sum += rough * grained * ((1.0f - a.t) * low + a.t * high);
  }
  BounceCosines result{min(kGreatest * axis.scale(w.z) * sum, Lanes{} + 1.0f)};
  result.values[BounceCosines::kMissing] = sum[BounceCosines::kMissing];
  return result;
}

}  // namespace photopic
