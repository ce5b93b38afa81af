#include "core/glass_albedo.h"

#include <tbb/parallel_for.h>

#include "core/albedo_axes.h"
#include "core/fresnel.h"

namespace photopic {
namespace {

constexpr int kCosines = 64;

float node(GlassAlbedo::Range range, int i, int count) {
  if (count == 1) return range.low;
  return range.low + (range.high - range.low) * static_cast<float>(i) / static_cast<float>(count - 1);
}

TablePosition place(GlassAlbedo::Range range, float x, int count) {
  if (count == 1) return {0, 0.0f};
  return locate((x - range.low) / (range.high - range.low), count);
}

// Visible-normal sampling leaves F·G2/G1 of the reflected and (1 − F)·G2/G1 of the refracted direction to
// average; steep normals, where light is lost, are drawn more often.
float integrate(float cos_theta, float roughness, float eta, std::uint32_t samples) {
  const Ggx ggx{std::max(sqr(roughness), 1e-4f)};
  const Vec3f wo{safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta};
  float sum = 0.0f;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const Sample2d u = SampleStream(Sequence::sobol, 0, 0, i).get_2d(0);
    const Vec3f m = ggx.sample_visible(wo, {u.x, 1.0f - sqr(u.y)});
    const float cos_i = dot(wo, m), f = fresnel_dielectric(cos_i, eta);
    const Vec3f up = reflect(wo, m);
    if (up.z > 0.0f) sum += 2.0f * u.y * f * ggx.g2(wo, up);
    if (f == 1.0f) continue;
    const Vec3f down = refract(wo, m, eta);
    if (down.z < 0.0f) sum += 2.0f * u.y * (1.0f - f) * ggx.g2(wo, down);
  }
  return sum / (static_cast<float>(samples) * ggx.g1(wo));
}

}  // namespace

GlassAlbedo::GlassAlbedo(Range ior, Range roughness)
    : ior_(ior),
      roughness_(roughness),
      iors_(ior.low == ior.high ? 1 : 5),
      roughnesses_(roughness.low == roughness.high ? 1 : 24),
      share_(entry(iors_, 0, false, 0)) {
  const std::uint32_t samples = roughnesses_ == 1 ? 4096 : 1024;
  tbb::parallel_for(0, iors_ * roughnesses_, [&](int i) {
    const int r = i % roughnesses_, n = i / roughnesses_;
    const float alpha_root = node(roughness_, r, roughnesses_), eta = node(ior_, n, iors_);
    for (int c = 0; c < kCosines; ++c) {
      const float cos_theta = albedo_cosine(c, kCosines);
      share_[entry(n, r, false, c)] = integrate(cos_theta, alpha_root, eta, samples);
      share_[entry(n, r, true, c)] = integrate(cos_theta, alpha_root, 1.0f / eta, samples);
    }
  });
}

std::size_t GlassAlbedo::entry(int ior, int roughness, bool inside, int cosine) const {
  return static_cast<std::size_t>(((ior * roughnesses_ + roughness) * 2 + inside) * kCosines + cosine);
}

float GlassAlbedo::row(int ior, int roughness, bool inside, float cos_theta) const {
  const auto c = locate_cosine(cos_theta, kCosines);
  return c.weight(0) * share_[entry(ior, roughness, inside, c.cell)] +
         c.weight(1) * share_[entry(ior, roughness, inside, c.cell + 1)];
}

float GlassAlbedo::operator()(float cos_theta, float roughness, float ior, bool inside) const {
  const TablePosition n = place(ior_, ior, iors_), r = place(roughness_, roughness, roughnesses_);
  float share = 0.0f;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (const float weight = n.weight(i) * r.weight(j); weight > 0.0f)
        share += weight * row(n.cell + i, r.cell + j, inside, cos_theta);
  return share;
}

}  // namespace photopic
