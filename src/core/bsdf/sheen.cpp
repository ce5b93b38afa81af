#include "core/bsdf/sheen.h"

#include <tbb/parallel_for.h>

#include "core/bsdf/albedo_axes.h"

namespace photopic {
namespace {

/// Below it the fibres' lobe is too sharp for single precision.
constexpr float kLeastRoughness = 0.07f;

float mix(float a, float b, float t) {
  return a + (b - a) * t;
}

// Estevez & Kulla 2017, equation 3 and table 1.
float fitted(float x, float alpha) {
  const float t = sqr(1.0f - alpha);
  const float a = mix(21.5473f, 25.3245f, t), b = mix(3.82987f, 3.32435f, t), c = mix(0.19823f, 0.16801f, t);
  const float d = mix(-1.97760f, -1.27393f, t), e = mix(-4.32054f, -4.85967f, t);
  return a / (1.0f + b * std::pow(x, c)) + d * x + e;
}

float lambda(float cos_theta, float alpha) {
  if (cos_theta < 0.5f) return std::exp(fitted(cos_theta, alpha));
  return std::exp(2.0f * fitted(0.5f, alpha) - fitted(std::max(1.0f - cos_theta, 0.0f), alpha));
}

float alpha_of(float roughness) {
  return sqr(std::max(roughness, kLeastRoughness));
}

/// f·cos θi from the formulas. [1/sr]
float charlie(Vec3f wo, Vec3f wi, float alpha) {
  const Vec3f m = normalize(wo + wi);
  const float sin_m = safe_sqrt(1.0f - sqr(m.z)), power = 1.0f / alpha;
  const float d = (2.0f + power) * std::pow(sin_m, power) * (0.5f * kInvPi);
  return d / ((1.0f + lambda(wo.z, alpha) + lambda(wi.z, alpha)) * 4.0f * wo.z);
}

/// The axis of roughness, in equal steps of its square root.
const float kLeastRoot = std::sqrt(kLeastRoughness);

/// ∫ of charlie() over rings of directions that stand at cos θ = x², x in equal steps: grazing ones are
/// dense.
constexpr int kRings = 48;
float ring_cosine(std::size_t i) {
  return sqr((static_cast<float>(i) + 0.5f) / kRings);
}
std::array<float, kRings> ring_shares(float cos_theta, float alpha) {
  constexpr int kTurns = 48;  // of half a turn
  const Vec3f wo{safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta};
  std::array<float, kRings> shares{};
  for (std::size_t i = 0; i < kRings; ++i) {
    const float z = ring_cosine(i), r = safe_sqrt(1.0f - sqr(z));
    for (int j = 0; j < kTurns; ++j) {
      const SinCos phi = sin_cos_two_pi(0.5f * (static_cast<float>(j) + 0.5f) / kTurns);
      shares[i] += charlie(wo, {r * phi.cos, r * phi.sin, z}, alpha);
    }
    shares[i] *= 2.0f * kPi / kTurns * 2.0f * std::sqrt(z) / kRings;
  }
  return shares;
}

}  // namespace

Sheen::Sheen(float roughness, Vec3f wo)
    : wo_(wo),
      roughness_(roughness),
      albedo_(0.0f),
      scale_(0.0f),
      spread_(std::max(roughness, kLeastRoughness)) {
  if (wo.z <= 0.0f) return;
  const SheenAlbedo::Entry entry = SheenAlbedo::table()(wo.z, roughness);
  albedo_ = entry.albedo, scale_ = entry.scale;
}

float Sheen::evaluate(Vec3f wi) const {
  if (scale_ == 0.0f) return 0.0f;
  return scale_ * SheenAlbedo::table()(wi.z, roughness_).scale * charlie(wo_, wi, alpha_of(roughness_));
}

Vec3f Sheen::sample(Sample2d u) const {
  const float z = std::min(spread_ * u.x / (1.0f + spread_ - u.x), 1.0f), r = std::sqrt(1.0f - sqr(z));
  const SinCos phi = sin_cos_two_pi(u.y);
  return {r * phi.cos, r * phi.sin, z};
}

const SheenAlbedo& SheenAlbedo::table() {
  static const SheenAlbedo all;
  return all;
}

SheenAlbedo::SheenAlbedo() {
  tbb::parallel_for(0, kRoughnesses, [&](int r) {
    const float root = mix(kLeastRoot, 1.0f, static_cast<float>(r) / (kRoughnesses - 1));
    rows_[static_cast<std::size_t>(r)] = row(sqr(root));
  });
}

/// Finds s so that no albedo s(wo) ∫ f·s(wi) exceeds 1, by steps that halve the excess on either side.
SheenAlbedo::Row SheenAlbedo::row(float roughness) {
  constexpr int kIterations = 20;
  std::array<std::array<float, kRings>, kCosines> shares;
  for (std::size_t c = 0; c < kCosines; ++c)
    shares[c] = ring_shares(albedo_cosine(static_cast<int>(c), kCosines), alpha_of(roughness));
  Row row;
  for (Entry& e : row) e.scale = 1.0f;
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    std::array<float, kRings> scales;
    for (std::size_t i = 0; i < kRings; ++i) scales[i] = at(row, ring_cosine(i)).scale;
    for (std::size_t c = 0; c < kCosines; ++c) {
      float sum = 0.0f;
      for (std::size_t i = 0; i < kRings; ++i) sum += shares[c][i] * scales[i];
      row[c].albedo = row[c].scale * sum;
    }
    if (iteration < kIterations)
      for (Entry& e : row) e.scale /= std::sqrt(std::max(e.albedo, 1.0f));
  }
  for (Entry& e : row) e.albedo = std::min(e.albedo, 1.0f);
  return row;
}

SheenAlbedo::Entry SheenAlbedo::at(const Row& row, float cos_theta) {
  const TablePosition c = locate_cosine(cos_theta, kCosines);
  const Entry a = row[static_cast<std::size_t>(c.cell)], b = row[static_cast<std::size_t>(c.cell + 1)];
  return {mix(a.scale, b.scale, c.t), mix(a.albedo, b.albedo, c.t)};
}

SheenAlbedo::Entry SheenAlbedo::operator()(float cos_theta, float roughness) const {
  const float root = std::sqrt(std::max(roughness, kLeastRoughness));
  const TablePosition r = locate((root - kLeastRoot) / (1.0f - kLeastRoot), kRoughnesses);
  const Entry a = at(rows_[static_cast<std::size_t>(r.cell)], cos_theta),
              b = at(rows_[static_cast<std::size_t>(r.cell + 1)], cos_theta);
  return {mix(a.scale, b.scale, r.t), mix(a.albedo, b.albedo, r.t)};
}

}  // namespace photopic
