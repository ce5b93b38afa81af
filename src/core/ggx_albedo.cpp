#include "core/ggx_albedo.h"

#include <tbb/parallel_for.h>

#include "core/albedo_axes.h"
#include "core/fresnel.h"

namespace photopic {
namespace {

using Factors = GgxAlbedo::Factors;

Factors lerp(Factors a, Factors b, float t) {
  return {a.missing + (b.missing - a.missing) * t, a.bias + (b.bias - a.bias) * t};
}

// Visible-normal sampling leaves F·G2/G1 to average; steep normals, where light is lost, are drawn more
// often.
Factors integrate(float cos_theta, float roughness) {
  constexpr std::uint32_t kSamples = 1024;
  const Ggx ggx{sqr(roughness)};
  const Vec3f wo{safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta};
  Factors sum{0.0f, 0.0f};
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Sample2d u = SampleStream(Sequence::sobol, 0, 0, i).get_2d(0);
    const Vec3f m = ggx.sample_visible(wo, {u.x, 1.0f - sqr(u.y)});
    const Vec3f wi = reflect(wo, m);
    const float weight = 2.0f * u.y, shadow = shadowing(ggx, wo, wi);
    sum.missing += weight / (1.0f + 1.0f / shadow);
    sum.bias += weight / (1.0f + shadow) * schlick_weight(dot(wo, m));
  }
  return {sum.missing / kSamples, sum.bias / kSamples};
}

}  // namespace

const GgxAlbedo& GgxAlbedo::table() {
  static const GgxAlbedo table;
  return table;
}

GgxAlbedo::GgxAlbedo() {
  const auto share = cosine_average_weights([](float c) { return locate_cosine(c, kCosines); }, kCosines);
  tbb::parallel_for(0, kRoughnesses, [&](int r) {
    for (int c = 0; c < kCosines; ++c)
      directional_[r][c] = integrate(albedo_cosine(c, kCosines), albedo_roughness(r, kRoughnesses));
    Factors sum{0.0f, 0.0f};
    for (int c = 0; c < kCosines; ++c) {
      sum.missing += share[c] * directional_[r][c].missing;
      sum.bias += share[c] * directional_[r][c].bias;
    }
    average_[r] = sum;
  });
}

Factors GgxAlbedo::directional(float cos_theta, float roughness) const {
  const auto [r, tr] = locate_roughness(roughness, kRoughnesses);
  const auto [c, tc] = locate_cosine(cos_theta, kCosines);
  return lerp(lerp(directional_[r][c], directional_[r][c + 1], tc),
              lerp(directional_[r + 1][c], directional_[r + 1][c + 1], tc), tr);
}

Factors GgxAlbedo::average(float roughness) const {
  const auto [r, t] = locate_roughness(roughness, kRoughnesses);
  return lerp(average_[r], average_[r + 1], t);
}

}  // namespace photopic
