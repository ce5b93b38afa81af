#include "core/ggx_albedo.h"

#include "core/fresnel.h"
#include "core/microfacet.h"
#include "core/table_position.h"

namespace photopic {
namespace {

using Factors = GgxAlbedo::Factors;

Factors lerp(Factors a, Factors b, float t) {
  return {a.scale + (b.scale - a.scale) * t, a.bias + (b.bias - a.bias) * t};
}

// Visible-normal sampling leaves F·G2/G1 to average.
Factors integrate(float cos_theta, float roughness) {
  constexpr std::uint32_t kSamples = 512;
  const Ggx ggx{std::max(sqr(roughness), 1e-4f)};
  const Vec3f wo{safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta};
  Factors sum{0.0f, 0.0f};
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Sample2d u = SampleStream(Sequence::sobol, 0, 0, i).get_2d(0);
    const Vec3f m = ggx.sample_visible(wo, u);
    const Vec3f wi = reflect(wo, m);
    if (wi.z <= 0.0f) continue;
    const float weight = ggx.g2(wo, wi) / ggx.g1(wo);
    const float schlick = schlick_weight(dot(wo, m));
    sum.scale += weight * (1.0f - schlick);
    sum.bias += weight * schlick;
  }
  return {sum.scale / kSamples, sum.bias / kSamples};
}

}  // namespace

const GgxAlbedo& GgxAlbedo::table() {
  static const GgxAlbedo table;
  return table;
}

GgxAlbedo::GgxAlbedo() {
  for (int r = 0; r < kSize; ++r) {
    const float roughness = static_cast<float>(r) / (kSize - 1);
    for (int c = 0; c < kSize; ++c)
      directional_[r][c] = integrate(std::max(sqr(static_cast<float>(c) / (kSize - 1)), 1e-4f), roughness);
    // Between two entries the albedo is linear in x = √μ, and 2μ dμ = 4x³ dx: the moments of x³ and x⁴.
    Factors sum{0.0f, 0.0f};
    for (int c = 0; c + 1 < kSize; ++c) {
      const float a = static_cast<float>(c) / (kSize - 1), b = static_cast<float>(c + 1) / (kSize - 1);
      const float whole = sqr(sqr(b)) - sqr(sqr(a));
      const float first = 0.8f * (sqr(sqr(b)) * b - sqr(sqr(a)) * a);
      const Factors mean = lerp(directional_[r][c], directional_[r][c + 1], (first / whole - a) / (b - a));
      sum.scale += whole * mean.scale;
      sum.bias += whole * mean.bias;
    }
    average_[r] = sum;
  }
}

Factors GgxAlbedo::directional(float cos_theta, float roughness) const {
  const auto [r, tr] = locate(roughness, kSize);
  const auto [c, tc] = locate(safe_sqrt(cos_theta), kSize);
  return lerp(lerp(directional_[r][c], directional_[r][c + 1], tc),
              lerp(directional_[r + 1][c], directional_[r + 1][c + 1], tc), tr);
}

Factors GgxAlbedo::average(float roughness) const {
  const auto [r, t] = locate(roughness, kSize);
  return lerp(average_[r], average_[r + 1], t);
}

}  // namespace photopic
