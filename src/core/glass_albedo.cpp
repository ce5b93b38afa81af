#include "core/glass_albedo.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/albedo_axes.h"

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

}  // namespace

// Visible-normal sampling leaves F·G2/G1 of the reflected and (1 − F)·G2/G1 of the refracted direction to
// average.
void GlassAlbedo::integrate(const VisibleNormals& normals, float cos_theta, float roughness, float eta,
                            std::size_t entry) {
  const Ggx ggx{std::max(sqr(roughness), 1e-4f)};
  const Vec3f wo{safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta};
  Share& sum = share_[entry];
  for (int i = 0; i < normals.count(); ++i) {
    const Vec3f m = ggx.sample_visible(wo, normals.sample(i));
    const float cos_i = dot(wo, m), f = fresnel_dielectric(cos_i, eta);
    const float weight = normals.weight(i) / ggx.g1(wo);
    const Vec3f up = reflect(wo, m);
    const float up_share = up.z > 0.0f ? weight * ggx.g2(wo, up) : 0.0f;
    sum.total += f * up_share;
    if (f == 1.0f) continue;
    const Vec3f down = refract(wo, m, eta);
    const float down_share = down.z < 0.0f ? weight * ggx.g2(wo, down) : 0.0f;
    sum.total += (1.0f - f) * down_share;
    const float exchanged = down_share - up_share, thin = SpecularScale::thin_cosine(cos_i, eta);
    sum.exchanged += f * exchanged;
    sum.exchanged_grazing += f * exchanged * schlick_weight(thin);
    if (exchanged_.empty()) continue;
    const TablePosition place = locate(thin, kFilmNodes + 1);  // among 0 and the nodes
    if (place.cell > 0)
      exchanged_[entry][static_cast<std::size_t>(place.cell - 1)] += place.weight(0) * exchanged;
    exchanged_[entry][static_cast<std::size_t>(place.cell)] += place.weight(1) * exchanged;
  }
}

GlassAlbedo::GlassAlbedo(std::vector<float> iors, Range roughness, bool films)
    : iors_(std::move(iors)),
      roughness_(roughness),
      roughnesses_(roughness.low == roughness.high ? 1 : 24),
      share_(entry(iors_.size(), 0, false, 0)),
      exchanged_(films ? share_.size() : 0) {
  const std::size_t tables = iors_.size() * static_cast<std::size_t>(roughnesses_);
  const VisibleNormals normals(static_cast<int>(std::clamp<std::size_t>(16384 / tables, 1024, 4096)));
  tbb::parallel_for(std::size_t{0}, tables, [&](std::size_t i) {
    const std::size_t n = i / static_cast<std::size_t>(roughnesses_);
    const int r = static_cast<int>(i % static_cast<std::size_t>(roughnesses_));
    const float alpha_root = node(roughness_, r, roughnesses_), eta = iors_[n];
    for (int c = 0; c < kCosines; ++c) {
      const float cos_theta = albedo_cosine(c, kCosines);
      integrate(normals, cos_theta, alpha_root, eta, entry(n, r, false, c));
      integrate(normals, cos_theta, alpha_root, 1.0f / eta, entry(n, r, true, c));
    }
  });
}

std::size_t GlassAlbedo::entry(std::size_t ior, int roughness, bool inside, int cosine) const {
  const std::size_t row = ior * static_cast<std::size_t>(roughnesses_) + static_cast<std::size_t>(roughness);
  return (2 * row + (inside ? 1 : 0)) * kCosines + static_cast<std::size_t>(cosine);
}

float GlassAlbedo::row(std::size_t ior, int roughness, bool inside, float cos_theta,
                       const Reflection& reflection) const {
  const auto c = locate_cosine(cos_theta, kCosines);
  float share = 0.0f;
  for (int end = 0; end < 2; ++end) {
    const std::size_t at = entry(ior, roughness, inside, c.cell + end);
    share += c.weight(end) * share_[at].of(reflection.specular);
    if (reflection.film)
      for (std::size_t k = 0; k < kFilmNodes; ++k)
        share -= c.weight(end) * (*reflection.film)[k] * exchanged_[at][k];
  }
  return share;
}

float GlassAlbedo::operator()(float cos_theta, float roughness, float eta,
                              const Reflection& reflection) const {
  const bool inside = eta < 1.0f;
  const float ior = inside ? 1.0f / eta : eta;
  const auto above = static_cast<std::size_t>(std::ranges::lower_bound(iors_, ior) - iors_.begin());
  const std::size_t high = std::min(above, iors_.size() - 1), low = above == 0 ? 0 : above - 1;
  const float step = iors_[high] - iors_[low], t = step > 0.0f ? (ior - iors_[low]) / step : 0.0f;
  const TablePosition r = place(roughness_, roughness, roughnesses_);
  float share = 0.0f;
  for (int j = 0; j < 2; ++j)
    if (const float weight = r.weight(j); weight > 0.0f) {
      if (t < 1.0f) share += (1.0f - t) * weight * row(low, r.cell + j, inside, cos_theta, reflection);
      if (t > 0.0f) share += t * weight * row(high, r.cell + j, inside, cos_theta, reflection);
    }
  return share;
}

}  // namespace photopic
