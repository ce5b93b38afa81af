#include "core/grain_albedo.h"

#include <tbb/parallel_for.h>

#include "core/albedo_axes.h"

namespace photopic {
namespace {

using Weights = FresnelAlbedo::Weights;

/// Numbers of nodes. Roughness: alpha_y. Grain: where alpha_x stands between alpha_y and 1. Azimuth: where
/// the α that a direction sees stands between alpha_y and alpha_x. All by the eighth root of α, as
/// albedo_roughness is.
constexpr int kRoughnesses = 16, kGrains = 16, kAzimuths = 16, kCosines = 20;
constexpr int kFineRoughnesses = 32, kFineGrains = 24;  ///< of the averages

float root_of(float alpha) {
  return fourth_root(std::sqrt(alpha));
}
float alpha_of(float root) {
  return sqr(sqr(sqr(root)));
}

/// Where x stands between low and high; 0 where they are one.
float share(float x, float low, float high) {
  return high > low ? (x - low) / (high - low) : 0.0f;
}
float mix(float low, float high, int node, int nodes) {
  return low + (high - low) * static_cast<float>(node) / static_cast<float>(nodes - 1);
}

float alpha_seen(Vec3f w, const AnisotropicGgx& ggx) {
  const float across = sqr(w.x) + sqr(w.y);
  if (across == 0.0f) return ggx.alpha_y;
  return std::sqrt((sqr(w.x * ggx.alpha_x) + sqr(w.y * ggx.alpha_y)) / across);
}

AnisotropicGgx ggx_at(int roughness, int roughnesses, int grain, int grains) {
  const float alpha_y = sqr(albedo_roughness(roughness, roughnesses));
  return {alpha_of(mix(root_of(alpha_y), 1.0f, grain, grains)), alpha_y};
}

float alpha_seen_at(const AnisotropicGgx& ggx, int azimuth) {
  return alpha_of(mix(root_of(ggx.alpha_y), root_of(ggx.alpha_x), azimuth, kAzimuths));
}

Vec3f direction_at(const AnisotropicGgx& ggx, int azimuth, float z) {
  const float seen = alpha_seen_at(ggx, azimuth);
  const float cos2 = std::clamp(share(sqr(seen), sqr(ggx.alpha_y), sqr(ggx.alpha_x)), 0.0f, 1.0f);
  const float r = safe_sqrt(1.0f - sqr(z));
  return {r * std::sqrt(cos2), r * std::sqrt(1.0f - cos2), z};
}

TablePosition locate_roughness_of(const AnisotropicGgx& ggx, int roughnesses) {
  return locate_roughness(std::sqrt(ggx.alpha_y), roughnesses);
}
TablePosition locate_grain(const AnisotropicGgx& ggx, int grains) {
  return locate(share(root_of(ggx.alpha_x), root_of(ggx.alpha_y), 1.0f), grains);
}

std::size_t entry(int roughness, int grain, int azimuth, int cosine) {
  return static_cast<std::size_t>(((roughness * kGrains + grain) * kAzimuths + azimuth) * kCosines + cosine);
}

/// The isotropic surface that is most like it: at grazing angles of the α that the direction sees, from above
/// of the mean.
Weights alike(const AnisotropicGgx& ggx, float seen, float cos_theta) {
  const float mean = root_of(std::sqrt(0.5f * (sqr(ggx.alpha_x) + sqr(ggx.alpha_y))));
  const float alpha = alpha_of(mean + (root_of(seen) - mean) * sqr(sqr(1.0f - cos_theta)));
  return FresnelAlbedo::table().directional(cos_theta, std::sqrt(alpha));
}

}  // namespace

const GrainAlbedo& GrainAlbedo::table() {
  static const GrainAlbedo table;
  return table;
}

GrainAlbedo::GrainAlbedo()
    : correction_(entry(kRoughnesses, 0, 0, 0)), average_(kFineRoughnesses * kFineGrains) {
  tbb::parallel_for(0, kRoughnesses * kGrains, [&](int i) {
    const int r = i / kGrains, g = i % kGrains;
    const AnisotropicGgx ggx = ggx_at(r, kRoughnesses, g, kGrains);
    for (int a = 0; a < kAzimuths; ++a)
      for (int c = 0; c < kCosines; ++c) {
        const float z = albedo_cosine(c, kCosines);
        Weights& correction = correction_[entry(r, g, a, c)];
        correction = FresnelAlbedo::integrate(ggx, direction_at(ggx, a, z), 256);
        correction.add(alike(ggx, alpha_seen_at(ggx, a), z), -1.0f);
      }
  });
  tbb::parallel_for(0, kFineRoughnesses * kFineGrains, [&](int i) {
    Weights& average = average_[static_cast<std::size_t>(i)];
    average = average_of(ggx_at(i / kFineGrains, kFineRoughnesses, i % kFineGrains, kFineGrains));
    average.missing = std::log(average.missing);
  });
}

Weights GrainAlbedo::average_of(const AnisotropicGgx& ggx) const {
  constexpr int kTurns = 32, kHeights = 64;
  Weights average;
  for (int i = 0; i < kTurns; ++i)
    for (int j = 0; j < kHeights; ++j) {  // μ = x³, 2μ dμ = 6x⁵ dx
      const SinCos phi = sin_cos_two_pi(0.25f * (static_cast<float>(i) + 0.5f) / kTurns);
      const float x = (static_cast<float>(j) + 0.5f) / kHeights, z = x * x * x, r = std::sqrt(1.0f - z * z);
      average.add(directional({r * phi.cos, r * phi.sin, z}, ggx),
                  6.0f * sqr(sqr(x)) * x / (kTurns * kHeights));
    }
  return average;
}

Weights GrainAlbedo::directional(Vec3f w, const AnisotropicGgx& ggx) const {
  const float seen = alpha_seen(w, ggx);
  const auto r = locate_roughness_of(ggx, kRoughnesses), g = locate_grain(ggx, kGrains),
             a = locate(share(root_of(seen), root_of(ggx.alpha_y), root_of(ggx.alpha_x)), kAzimuths),
             c = locate_cosine(w.z, kCosines);
  Weights correction;
  for (int i = 0; i < 16; ++i) {
    const int dr = i & 1, dg = i >> 1 & 1, da = i >> 2 & 1, dc = i >> 3 & 1;
    const float weight = r.weight(dr) * g.weight(dg) * a.weight(da) * c.weight(dc);
    if (weight > 0.0f)
      correction.add(correction_[entry(r.cell + dr, g.cell + dg, a.cell + da, c.cell + dc)], weight);
  }
  Weights weights = alike(ggx, seen, w.z);
  weights.add(correction, 1.0f);
  weights.missing = std::clamp(weights.missing, 1e-7f, 1.0f);
  weights.f0 = 1.0f - weights.missing - weights.f90;
  return weights;
}

Weights GrainAlbedo::average(const AnisotropicGgx& ggx) const {
  const auto r = locate_roughness_of(ggx, kFineRoughnesses), g = locate_grain(ggx, kFineGrains);
  Weights weights;
  for (int dr = 0; dr < 2; ++dr)
    for (int dg = 0; dg < 2; ++dg)
      weights.add(average_[static_cast<std::size_t>((r.cell + dr) * kFineGrains + g.cell + dg)],
                  r.weight(dr) * g.weight(dg));
  weights.missing = std::exp(weights.missing);
  weights.f0 = 1.0f - weights.missing - weights.f90;
  return weights;
}

}  // namespace photopic
