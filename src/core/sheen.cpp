#include "core/sheen.h"

#include <tbb/parallel_for.h>

#include "core/table_position.h"

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
  return std::exp(2.0f * fitted(0.5f, alpha) - fitted(1.0f - cos_theta, alpha));
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

}  // namespace

Sheen::Sheen(float roughness, Vec3f wo) : wo_(wo), roughness_(roughness), albedo_(0.0f), scale_(0.0f) {
  if (wo.z <= 0.0f) return;
  const float raw = SheenAlbedo::table()(wo.z, roughness);
  albedo_ = std::min(raw, 1.0f);
  scale_ = raw > 1.0f ? 1.0f / raw : 1.0f;
}

float Sheen::evaluate(Vec3f wi) const {
  return scale_ == 0.0f ? 0.0f : scale_ * charlie(wo_, wi, alpha_of(roughness_));
}

float Sheen::integrate(float cos_theta, float roughness) {
  constexpr int kSteps = 48;
  const Vec3f wo{safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta};
  const float alpha = alpha_of(roughness);
  float sum = 0.0f;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {  // cos θ = x², so that grazing angles are dense; half the azimuths
      const float x = (static_cast<float>(i) + 0.5f) / kSteps, z = sqr(x), r = safe_sqrt(1.0f - sqr(z));
      const float phi = kPi * (static_cast<float>(j) + 0.5f) / kSteps;
      sum += charlie(wo, {r * std::cos(phi), r * std::sin(phi), z}, alpha) * 2.0f * x;
    }
  return sum * 2.0f * kPi / sqr(kSteps);
}

const SheenAlbedo& SheenAlbedo::table() {
  static const SheenAlbedo all;
  return all;
}

SheenAlbedo::SheenAlbedo() {
  tbb::parallel_for(0, kSize, [&](int r) {
    for (int c = 0; c < kSize; ++c) {
      const float root = std::max(static_cast<float>(c) / (kSize - 1), 0.02f);
      albedo_[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
          Sheen::integrate(sqr(root), static_cast<float>(r) / (kSize - 1));
    }
  });
}

float SheenAlbedo::operator()(float cos_theta, float roughness) const {
  const auto r = locate(roughness, kSize), c = locate(safe_sqrt(cos_theta), kSize);
  const auto row = [&](int i) {
    const auto& a = albedo_[static_cast<std::size_t>(i)];
    return c.weight(0) * a[static_cast<std::size_t>(c.cell)] +
           c.weight(1) * a[static_cast<std::size_t>(c.cell + 1)];
  };
  return r.weight(0) * row(r.cell) + r.weight(1) * row(r.cell + 1);
}

}  // namespace photopic
