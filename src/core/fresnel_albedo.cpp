#include "core/fresnel_albedo.h"

#include <tbb/parallel_for.h>

#include "core/albedo_axes.h"
#include "core/anisotropic_ggx.h"
#include "core/fresnel.h"

namespace photopic {
namespace {

using Weights = FresnelAlbedo::Weights;

/// The axis of cos θ: fourth roots up to the first node of the rest, from there on equal steps that meet
/// every node, where the weights of smooth surfaces have kinks.
constexpr int kNearHorizon = 32, kPerNode = 4;
constexpr int kCosines = kNearHorizon + FresnelAlbedo::kNodes * kPerNode + 1;

float cosine(int i) {
  const float first = FresnelAlbedo::node(0);
  if (i <= kNearHorizon) return first * albedo_cosine(i, kNearHorizon + 1);
  return first * (1.0f + static_cast<float>(i - kNearHorizon) / kPerNode);
}

TablePosition locate_cosine_by_node(float cos_theta) {
  const float nodes = cos_theta * (FresnelAlbedo::kNodes + 1);
  if (nodes < 1.0f) return locate_cosine(nodes, kNearHorizon + 1);
  TablePosition place = locate((nodes - 1.0f) / FresnelAlbedo::kNodes, FresnelAlbedo::kNodes * kPerNode + 1);
  place.cell += kNearHorizon;
  return place;
}

const Weights& entry(const std::vector<Weights>& table, int roughness, int cosine) {
  return table[static_cast<std::size_t>(roughness * kCosines + cosine)];
}

}  // namespace

void FresnelAlbedo::Weights::add(const Weights& other, float factor) {
  f0 += factor * other.f0;
  f90 += factor * other.f90;
  missing += factor * other.missing;
  for (std::size_t k = 0; k < kNodes; ++k) rest[k] += factor * other.rest[k];
}

FresnelAlbedo::Weights FresnelAlbedo::at(float cos_theta) {
  Weights weights;
  weights.f90 = schlick_weight(cos_theta);
  weights.f0 = 1.0f - weights.f90;
  const auto place = locate(cos_theta, kNodes + 2);  // among the nodes, 0 and 1
  if (place.cell > 0) weights.rest[static_cast<std::size_t>(place.cell - 1)] = 1.0f - place.t;
  if (place.cell < kNodes) weights.rest[static_cast<std::size_t>(place.cell)] = place.t;
  return weights;
}

// Visible-normal sampling leaves F·G2/G1 to average; steep normals, where light is lost, are drawn more
// often.
template <typename AnyGgx>
Weights FresnelAlbedo::integrate(const AnyGgx& ggx, Vec3f wo, int samples) {
  Weights mean;
  for (int i = 0; i < samples; ++i) {
    const Sample2d u = SampleStream(Sequence::sobol, 0, 0, static_cast<std::uint32_t>(i)).get_2d(0);
    const Vec3f m = ggx.sample_visible(wo, {u.x, 1.0f - sqr(u.y)});
    const Vec3f wi = reflect(wo, m);
    const float weight = 2.0f * u.y / static_cast<float>(samples), shadow = shadowing(ggx, wo, wi);
    if (wi.z > 0.0f) mean.add(at(dot(wo, m)), weight / (1.0f + shadow));
    mean.missing += weight / (1.0f + 1.0f / shadow);
  }
  mean.f0 = 1.0f - mean.missing - mean.f90;
  return mean;
}
template Weights FresnelAlbedo::integrate(const Ggx&, Vec3f, int);
template Weights FresnelAlbedo::integrate(const AnisotropicGgx&, Vec3f, int);

const FresnelAlbedo& FresnelAlbedo::table() {
  static const FresnelAlbedo table;
  return table;
}

FresnelAlbedo::FresnelAlbedo() : directional_(kRoughnesses * kCosines), average_(kRoughnesses) {
  const auto share = cosine_average_weights(locate_cosine_by_node, kCosines);
  tbb::parallel_for(0, kRoughnesses, [&](int r) {
    const Ggx ggx{sqr(albedo_roughness(r, kRoughnesses))};
    for (int c = 0; c < kCosines; ++c) {
      const float z = cosine(c);
      const Weights w = integrate(ggx, {safe_sqrt(1.0f - sqr(z)), 0.0f, z}, 1024);
      directional_[static_cast<std::size_t>(r * kCosines + c)] = w;
      average_[static_cast<std::size_t>(r)].add(w, share[static_cast<std::size_t>(c)]);
    }
  });
}

Weights FresnelAlbedo::directional(float cos_theta, float roughness) const {
  const auto r = locate_roughness(roughness, kRoughnesses), c = locate_cosine_by_node(cos_theta);
  Weights weights;
  for (int dr = 0; dr < 2; ++dr)
    for (int dc = 0; dc < 2; ++dc)
      weights.add(entry(directional_, r.cell + dr, c.cell + dc), r.weight(dr) * c.weight(dc));
  return weights;
}

Weights FresnelAlbedo::average(float roughness) const {
  const auto r = locate_roughness(roughness, kRoughnesses);
  Weights weights;
  for (int dr = 0; dr < 2; ++dr) weights.add(average_[static_cast<std::size_t>(r.cell + dr)], r.weight(dr));
  return weights;
}

}  // namespace photopic
