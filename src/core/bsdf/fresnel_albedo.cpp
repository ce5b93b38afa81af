#include "core/bsdf/fresnel_albedo.h"

#include <tbb/parallel_for.h>

#include "core/bsdf/fresnel.h"
#include "core/bsdf/node_cosines.h"

namespace photopic {
namespace {

using Weights = FresnelAlbedo::Weights;

constexpr NodeCosines kAxis{32, 8};

const Weights& entry(const std::vector<Weights>& table, int roughness, int cosine) {
  return table[static_cast<std::size_t>(roughness * kAxis.size() + cosine)];
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

Weights FresnelAlbedo::integrate(const VisibleNormals& normals, const AnisotropicGgx& ggx, Vec3f wo) {
  const VisibleNormals::Bounces bounces = normals.bounces(ggx, wo);
  Weights sum;
  std::array<float, kNodes + 2> share{};  // of the nodes, 0 and 1
  bounces.for_each([&](float cosine, float kept) {
    sum.f90 += kept * schlick_weight(cosine);
    const TablePosition place = locate(cosine, kNodes + 2);
    for (int end = 0; end < 2; ++end)
      share[static_cast<std::size_t>(place.cell + end)] += kept * place.weight(end);
  });
  std::copy_n(share.begin() + 1, kNodes, sum.rest.begin());
  sum.missing = bounces.missing;
  sum.f0 = 1.0f - sum.missing - sum.f90;
  return sum;
}

const FresnelAlbedo& FresnelAlbedo::table() {
  static const FresnelAlbedo table;
  return table;
}

FresnelAlbedo::FresnelAlbedo()
    : directional_(static_cast<std::size_t>(kRoughnesses * kAxis.size())), average_(kRoughnesses) {
  const VisibleNormals normals(1024);
  const auto share = cosine_average_weights([](float c) { return kAxis.locate(c); }, kAxis.size());
  tbb::parallel_for(0, kRoughnesses, [&](int r) {
    const float alpha = sqr(albedo_roughness(r, kRoughnesses));
    for (int c = 0; c < kAxis.size(); ++c) {
      const float z = kAxis[c];
      const Weights w = integrate(normals, {alpha, alpha}, {safe_sqrt(1.0f - sqr(z)), 0.0f, z});
      directional_[static_cast<std::size_t>(r * kAxis.size() + c)] = w;
      average_[static_cast<std::size_t>(r)].add(w, share[static_cast<std::size_t>(c)]);
    }
  });
}

Weights FresnelAlbedo::directional(float cos_theta, float roughness) const {
  const auto r = locate_roughness(roughness, kRoughnesses), c = kAxis.locate(cos_theta);
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
