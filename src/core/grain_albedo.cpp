#include "core/grain_albedo.h"

#include <tbb/parallel_for.h>

namespace photopic {
namespace {

using Weights = FresnelAlbedo::Weights;

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

float alpha_seen(Vec3f w, const AnisotropicGgx& ggx) {
  const float across = sqr(w.x) + sqr(w.y);
  if (across == 0.0f) return ggx.alpha_y;
  return std::sqrt((sqr(w.x * ggx.alpha_x) + sqr(w.y * ggx.alpha_y)) / across);
}

/// The axis of azimuths, in [0, 1]. Roots alone would be coarse where one looks along a strong grain.
float azimuth_of(float seen, const AnisotropicGgx& ggx) {
  return 0.8f * share(root_of(seen), root_of(ggx.alpha_y), root_of(ggx.alpha_x)) +
         0.2f * share(seen, ggx.alpha_y, ggx.alpha_x);
}
Vec3f direction_at(const AnisotropicGgx& ggx, float azimuth, float z) {
  float low = ggx.alpha_y, high = ggx.alpha_x;
  for (int i = 0; i < 24; ++i) {
    const float middle = 0.5f * (low + high);
    (azimuth_of(middle, ggx) < azimuth ? low : high) = middle;
  }
  const float seen = azimuth < 0.5f ? low : high;  // exact at the ends
  const float cos2 = std::clamp(share(sqr(seen), sqr(ggx.alpha_y), sqr(ggx.alpha_x)), 0.0f, 1.0f);
  const float r = safe_sqrt(1.0f - sqr(z));
  return {r * std::sqrt(cos2), r * std::sqrt(1.0f - cos2), z};
}

/// The axes of roughness and grain; of one node where there is but one surface.
TablePosition locate_roughness_of(const AnisotropicGgx& ggx, int size) {
  return size == 1 ? TablePosition{0, 0.0f} : locate_roughness(std::sqrt(ggx.alpha_y), size);
}
TablePosition locate_grain(const AnisotropicGgx& ggx, int size) {
  if (size == 1) return {0, 0.0f};
  return locate(share(root_of(ggx.alpha_x), root_of(ggx.alpha_y), 1.0f), size);
}
AnisotropicGgx ggx_at(int roughness, int roughnesses, int grain, int grains) {
  const float alpha_y = sqr(albedo_roughness(roughness, roughnesses)), root = root_of(alpha_y);
  return {alpha_of(root + (1.0f - root) * static_cast<float>(grain) / static_cast<float>(grains - 1)),
          alpha_y};
}

/// Calls f(i, j, weight) for the nodes of two axes around a place.
template <typename F>
void for_corners(TablePosition a, TablePosition b, const F& f) {
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (const float weight = a.weight(i) * b.weight(j); weight > 0.0f) f(a.cell + i, b.cell + j, weight);
}

}  // namespace

std::size_t GrainAlbedo::row(int roughness, int grain, int azimuth) const {
  return static_cast<std::size_t>((roughness * axes_.grains + grain) * axes_.azimuths + azimuth);
}

GrainAlbedo::GrainAlbedo(const AnisotropicGgx& ggx) : axes_{1, 1, 48, {32, 4}, 1, 1} {
  fill([&](int, int, int, int) { return ggx; }, 1024);
}

GrainAlbedo::GrainAlbedo() : axes_{24, 24, 20, {16, 2}, 47, 47} {
  fill(ggx_at, 256);
}

std::shared_ptr<const GrainAlbedo> GrainAlbedo::of_all() {
  static const std::shared_ptr<const GrainAlbedo> table(new GrainAlbedo);
  return table;
}

template <typename GgxAt>
void GrainAlbedo::fill(const GgxAt& ggx_at_nodes, int samples) {
  const VisibleNormals normals(samples);
  const NodeCosines& cosines = axes_.cosines;
  const auto share_of_height =
      cosine_average_weights([&](float c) { return cosines.locate(c); }, cosines.size());
  over_heights_.resize(row(axes_.roughnesses, 0, 0));
  directional_.resize(over_heights_.size() * static_cast<std::size_t>(cosines.size()));
  tbb::parallel_for(std::size_t{0}, over_heights_.size(), [&](std::size_t i) {
    const int a = static_cast<int>(i) % axes_.azimuths, rg = static_cast<int>(i) / axes_.azimuths;
    const AnisotropicGgx ggx =
        ggx_at_nodes(rg / axes_.grains, axes_.roughnesses, rg % axes_.grains, axes_.grains);
    const float azimuth = static_cast<float>(a) / static_cast<float>(axes_.azimuths - 1);
    for (int c = 0; c < cosines.size(); ++c) {
      const Weights w = FresnelAlbedo::integrate(normals, ggx, direction_at(ggx, azimuth, cosines[c]));
      directional_[i * static_cast<std::size_t>(cosines.size()) + static_cast<std::size_t>(c)] = w;
      over_heights_[i].add(w, share_of_height[static_cast<std::size_t>(c)]);
    }
  });
  average_.resize(static_cast<std::size_t>(axes_.average_roughnesses * axes_.average_grains));
  tbb::parallel_for(std::size_t{0}, average_.size(), [&](std::size_t i) {
    const int r = static_cast<int>(i) / axes_.average_grains, g = static_cast<int>(i) % axes_.average_grains;
    average_[i] = integrate_average(ggx_at_nodes(r, axes_.average_roughnesses, g, axes_.average_grains));
    average_[i].missing = std::log(std::max(average_[i].missing, 1e-7f));
  });
}

Weights GrainAlbedo::integrate_average(const AnisotropicGgx& ggx) const {
  constexpr int kTurns = 128;  // of a quarter
  std::vector<float> share_of_azimuth(static_cast<std::size_t>(axes_.azimuths));
  for (int i = 0; i < kTurns; ++i) {
    const SinCos phi = sin_cos_two_pi(0.25f * (static_cast<float>(i) + 0.5f) / kTurns);
    const TablePosition place =
        locate(azimuth_of(alpha_seen({phi.cos, phi.sin, 0.0f}, ggx), ggx), axes_.azimuths);
    for (int end = 0; end < 2; ++end)
      share_of_azimuth[static_cast<std::size_t>(place.cell + end)] += place.weight(end) / kTurns;
  }
  Weights average;
  for_corners(locate_roughness_of(ggx, axes_.roughnesses), locate_grain(ggx, axes_.grains),
              [&](int r, int g, float weight) {
                for (int a = 0; a < axes_.azimuths; ++a)
                  average.add(over_heights_[row(r, g, a)],
                              weight * share_of_azimuth[static_cast<std::size_t>(a)]);
              });
  return average;
}

Weights GrainAlbedo::directional(Vec3f w, const AnisotropicGgx& ggx) const {
  const auto a = locate(azimuth_of(alpha_seen(w, ggx), ggx), axes_.azimuths), c = axes_.cosines.locate(w.z);
  const auto cosines = static_cast<std::size_t>(axes_.cosines.size());
  Weights weights;
  for_corners(locate_roughness_of(ggx, axes_.roughnesses), locate_grain(ggx, axes_.grains),
              [&](int r, int g, float outer) {
                for_corners(a, c, [&](int azimuth, int cosine, float inner) {
                  weights.add(directional_[row(r, g, azimuth) * cosines + static_cast<std::size_t>(cosine)],
                              outer * inner);
                });
              });
  return weights;
}

Weights GrainAlbedo::average(const AnisotropicGgx& ggx) const {
  Weights weights;
  for_corners(locate_roughness_of(ggx, axes_.average_roughnesses), locate_grain(ggx, axes_.average_grains),
              [&](int r, int g, float weight) {
                weights.add(average_[static_cast<std::size_t>(r * axes_.average_grains + g)], weight);
              });
  weights.missing = std::exp(weights.missing);
  weights.f0 = 1.0f - weights.missing - weights.f90;
  return weights;
}

}  // namespace photopic
