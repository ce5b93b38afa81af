#include "core/ggx_albedo.h"

#include <tbb/parallel_for.h>

#include "core/albedo_axes.h"
#include "core/fresnel.h"
#include "core/visible_normals.h"

namespace photopic {
namespace {

using Factors = GgxAlbedo::Factors;

Factors lerp(Factors a, Factors b, float t) {
  return {a.missing + (b.missing - a.missing) * t, a.bias + (b.bias - a.bias) * t};
}

Factors integrate(const VisibleNormals& normals, float cos_theta, float roughness) {
  const VisibleNormals::Bounces bounces =
      normals.bounces({sqr(roughness), sqr(roughness)}, {safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta});
  Factors sum{bounces.missing, 0.0f};
  bounces.for_each([&](float cosine, float kept) { sum.bias += kept * schlick_weight(cosine); });
  return sum;
}

}  // namespace

const GgxAlbedo& GgxAlbedo::table() {
  static const GgxAlbedo table;
  return table;
}

GgxAlbedo::GgxAlbedo() {
  const VisibleNormals normals(1024);
  const auto share = cosine_average_weights([](float c) { return locate_cosine(c, kCosines); }, kCosines);
  tbb::parallel_for(0, kRoughnesses, [&](int r) {
    for (int c = 0; c < kCosines; ++c)
      directional_[r][c] = integrate(normals, albedo_cosine(c, kCosines), albedo_roughness(r, kRoughnesses));
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
