#pragma once

#include "core/bsdf/microfacet.h"

namespace photopic {

/// Ggx with a roughness of its own along each tangent (Heitz 2014, section 5.4); the same names, the same
/// measures.
struct AnisotropicGgx {
  float alpha_x, alpha_y;  ///< > 0

  float d(Vec3f m) const {
    if (m.z <= 0.0f) return 0.0f;
    const float k = sqr(m.x / alpha_x) + sqr(m.y / alpha_y) + sqr(m.z);
    return kInvPi / (alpha_x * alpha_y * k * k);
  }

  float lambda(Vec3f w) const {
    const float tan2 = (sqr(w.x * alpha_x) + sqr(w.y * alpha_y)) / sqr(w.z);
    return 0.5f * (std::sqrt(1.0f + tan2) - 1.0f);
  }
  float g1(Vec3f w) const { return 1.0f / (1.0f + lambda(w)); }
  float g2(Vec3f wo, Vec3f wi) const { return 1.0f / (1.0f + lambda(wo) + lambda(wi)); }

  /// A normal seen from w, w.z > 0: spherical caps, Dupuy & Benyoub 2023.
  Vec3f sample_visible(Vec3f w, Sample2d u) const {
    const Vec3f stretched = normalize(Vec3f{w.x * alpha_x, w.y * alpha_y, w.z});
    const SinCos phi = sin_cos_two_pi(u.x);
    const float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    const float r = safe_sqrt(1.0f - z * z);
    const Vec3f h = Vec3f{r * phi.cos, r * phi.sin, z} + stretched;
    return normalize(Vec3f{h.x * alpha_x, h.y * alpha_y, std::max(1e-6f, h.z)});
  }

  /// KHR_materials_anisotropy: the rougher direction is x. @param strength in [0, 1]
  static AnisotropicGgx of(float roughness, float strength) {
    const float alpha = sqr(roughness);
    if (strength == 0.0f) return {alpha, alpha};
    return {std::max(alpha + (1.0f - alpha) * sqr(strength), kSmoothAlpha), std::max(alpha, kSmoothAlpha)};
  }
};

}  // namespace photopic
