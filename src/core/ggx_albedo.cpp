#include "core/ggx_albedo.h"

#include "core/albedo_axes.h"

namespace photopic {
namespace {

using Factors = GgxAlbedo::Factors;

Factors lerp(Factors a, Factors b, float t) {
  return {a.missing + (b.missing - a.missing) * t, a.bias + (b.bias - a.bias) * t};
}

}  // namespace

Factors GgxAlbedo::directional(float cos_theta, float roughness) {
  const auto [r, tr] = locate_roughness(roughness, kRoughnesses);
  const auto [c, tc] = locate_cosine(cos_theta, kCosines);
  return lerp(lerp(kTable[r][c], kTable[r][c + 1], tc), lerp(kTable[r + 1][c], kTable[r + 1][c + 1], tc), tr);
}

Factors GgxAlbedo::average(float roughness) {
  const auto [r, t] = locate_roughness(roughness, kRoughnesses);
  return lerp(kTable[r][kCosines], kTable[r + 1][kCosines], t);
}

}  // namespace photopic
