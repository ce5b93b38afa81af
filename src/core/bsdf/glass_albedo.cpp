#include "core/bsdf/glass_albedo.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/bsdf/albedo_axes.h"

namespace photopic {
namespace {

constexpr int kCosines = 128, kRow = kCosines + 1;  // the average stands behind the cosines

float node(GlassAlbedo::Range range, int i, int count) {
  if (count == 1) return range.low;
  const float low = std::sqrt(range.low), high = std::sqrt(range.high);
  return sqr(low + (high - low) * static_cast<float>(i) / static_cast<float>(count - 1));
}

TablePosition place(GlassAlbedo::Range range, float x, int count) {
  if (count == 1) return {0, 0.0f};
  const float low = std::sqrt(range.low), high = std::sqrt(range.high);
  return locate((std::sqrt(x) - low) / (high - low), count);
}

}  // namespace

// Visible-normal sampling leaves 1 − G2/G1 of the reflected direction, weighed with F, and of the refracted
// one, with 1 − F, to average.
void GlassAlbedo::integrate(const VisibleNormals& normals, float cos_theta, float roughness, float eta,
                            std::size_t entry) {
  const Ggx ggx{std::max(sqr(roughness), 1e-4f)};
  const Vec3f wo{safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta};
  const float g1 = ggx.g1(wo);
  const auto lost = [&](Vec3f wi, bool leaves) {
    return leaves ? 1.0f / (1.0f + 1.0f / (ggx.lambda(wi) * g1)) : 1.0f;
  };
  // The lattice is turned from entry to entry (by the plastic number), lest its errors add up on average.
  const auto turn = static_cast<float>(std::fmod(static_cast<double>(entry) * 0.7548776662466927, 1.0));
  Share& sum = share_[entry];
  for (int i = 0; i < normals.count(); ++i) {
    Sample2d u = normals.sample(i);
    u.x += turn, u.x -= std::floor(u.x);
    const Vec3f m = ggx.sample_visible(wo, u);
    const float cos_i = dot(wo, m), f = fresnel_dielectric(cos_i, eta), weight = normals.weight(i);
    const Vec3f up = reflect(wo, m);
    const float lost_up = weight * lost(up, up.z > 0.0f);
    sum.missing += f * lost_up;
    if (f == 1.0f) continue;
    const Vec3f down = refract(wo, m, eta);
    const float lost_down = weight * lost(down, down.z < 0.0f);
    sum.missing += (1.0f - f) * lost_down;
    const float exchanged = lost_up - lost_down, thin = SpecularScale::thin_cosine(cos_i, eta);
    sum.all += exchanged;
    sum.exchanged += f * exchanged;
    sum.exchanged_grazing += f * exchanged * schlick_weight(thin);
    if (exchanged_.empty()) continue;
    const TablePosition place = locate(thin, kFilmNodes + 1);  // among 0 and the nodes
    Film& film = exchanged_[entry];
    if (place.cell > 0) film[static_cast<std::size_t>(place.cell - 1)] += place.weight(0) * exchanged;
    film[static_cast<std::size_t>(place.cell)] += place.weight(1) * exchanged;
  }
}

GlassAlbedo::GlassAlbedo(std::vector<float> iors, Range roughness, bool films)
    : iors_(std::move(iors)),
      roughness_(roughness),
      roughnesses_(roughness.low == roughness.high ? 1 : 24),
      share_(entry(iors_.size(), 0, false, 0)),
      exchanged_(films ? share_.size() : 0) {
  const std::size_t tables = iors_.size() * static_cast<std::size_t>(roughnesses_);
  const VisibleNormals normals(static_cast<int>(std::clamp<std::size_t>(8192 / tables, 512, 2048)));
  const auto weights = cosine_average_weights([](float c) { return locate_cosine(c, kCosines); }, kCosines);
  tbb::parallel_for(std::size_t{0}, 2 * tables, [&](std::size_t i) {
    const bool inside = i % 2 != 0;
    const std::size_t n = i / 2 / static_cast<std::size_t>(roughnesses_);
    const int r = static_cast<int>(i / 2 % static_cast<std::size_t>(roughnesses_));
    const float alpha_root = node(roughness_, r, roughnesses_), eta = inside ? 1.0f / iors_[n] : iors_[n];
    const std::size_t average = entry(n, r, inside, kCosines);
    for (int c = 0; c < kCosines; ++c) {
      const std::size_t at = entry(n, r, inside, c);
      const float weight = weights[static_cast<std::size_t>(c)];
      integrate(normals, albedo_cosine(c, kCosines), alpha_root, eta, at);
      share_[average].add(share_[at], weight);
      if (exchanged_.empty()) continue;
      for (std::size_t k = 0; k < kFilmNodes; ++k) exchanged_[average][k] += weight * exchanged_[at][k];
    }
  });
}

std::size_t GlassAlbedo::entry(std::size_t ior, int roughness, bool inside, int cosine) const {
  const std::size_t row = ior * static_cast<std::size_t>(roughnesses_) + static_cast<std::size_t>(roughness);
  return (2 * row + (inside ? 1 : 0)) * kRow + static_cast<std::size_t>(cosine);
}

float GlassAlbedo::of(std::size_t entry, const Reflection& reflection) const {
  float missing = share_[entry].of(reflection.specular);
  if (reflection.film)
    for (std::size_t k = 0; k < kFilmNodes; ++k) missing += (*reflection.film)[k] * exchanged_[entry][k];
  return missing;
}

/// @param row gives a value of the row that begins at an entry
template <typename F>
float GlassAlbedo::interpolate(float roughness, float eta, const F& row) const {
  const bool inside = eta < 1.0f;
  const float ior = inside ? 1.0f / eta : eta;
  const auto above = static_cast<std::size_t>(std::ranges::lower_bound(iors_, ior) - iors_.begin());
  const std::size_t high = std::min(above, iors_.size() - 1), low = above == 0 ? 0 : above - 1;
  const float step = iors_[high] - iors_[low], t = step > 0.0f ? (ior - iors_[low]) / step : 0.0f;
  const TablePosition r = place(roughness_, roughness, roughnesses_);
  float sum = 0.0f;
  for (int j = 0; j < 2; ++j)
    if (const float weight = r.weight(j); weight > 0.0f) {
      if (t < 1.0f) sum += (1.0f - t) * weight * row(entry(low, r.cell + j, inside, 0));
      if (t > 0.0f) sum += t * weight * row(entry(high, r.cell + j, inside, 0));
    }
  return sum;
}

float GlassAlbedo::missing(float cos_theta, float roughness, float eta, const Reflection& reflection) const {
  const TablePosition c = locate_cosine(cos_theta, kCosines);
  const auto cell = static_cast<std::size_t>(c.cell);
  const float missing = interpolate(roughness, eta, [&](std::size_t row) {
    return c.weight(0) * of(row + cell, reflection) + c.weight(1) * of(row + cell + 1, reflection);
  });
  return std::clamp(missing, 0.0f, 1.0f);
}

float GlassAlbedo::average_missing(float roughness, float eta, const Reflection& reflection) const {
  return std::max(
      interpolate(roughness, eta, [&](std::size_t row) { return of(row + kCosines, reflection); }), 1e-9f);
}

}  // namespace photopic
