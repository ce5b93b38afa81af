#pragma once

#include "core/math.h"
#include "core/sampling.h"

namespace photopic {

/// Below this α a microsurface is taken for a perfect mirror.
inline constexpr float kSmoothAlpha = 1e-3f;

/// Refraction through a rough surface needs a half vector, which there is not without a change of index:
/// where the ratio of the two is below this, either way, light goes straight on.
inline constexpr float kLeastRoughIor = 1.0001f;

inline bool is_index_matched(float eta) {
  return eta < kLeastRoughIor && eta * kLeastRoughIor > 1.0f;
}

/// The isotropic GGX distribution of microfacet normals (Walter et al. 2007), with visible-normal sampling.
/// All directions in the shading frame, unit length.
struct Ggx {
  float alpha;  ///< roughness², > 0

  /// D(m) [1/sr]; the form with sin²/α² keeps small α accurate.
  float d(Vec3f m) const {
    if (m.z <= 0.0f) return 0.0f;
    const float k = (m.x * m.x + m.y * m.y) / sqr(alpha) + m.z * m.z;
    return kInvPi / (sqr(alpha) * k * k);
  }

  float lambda(Vec3f w) const {
    const float tan2 = (w.x * w.x + w.y * w.y) / sqr(w.z);
    return 0.5f * (std::sqrt(1.0f + sqr(alpha) * tan2) - 1.0f);
  }
  /// Smith masking, and height-correlated masking-shadowing: Heitz 2014, equations 43 and 99.
  float g1(Vec3f w) const { return 1.0f / (1.0f + lambda(w)); }
  float g2(Vec3f wo, Vec3f wi) const { return 1.0f / (1.0f + lambda(wo) + lambda(wi)); }

  /// The density of the normals seen from w, w.z > 0 [1/sr]: Heitz & d'Eon 2014, equation 2.
  float visible_pdf(Vec3f w, Vec3f m) const { return g1(w) * d(m) * std::max(0.0f, dot(w, m)) / w.z; }

  /// A normal seen from w, w.z > 0: spherical caps, Dupuy & Benyoub 2023.
  Vec3f sample_visible(Vec3f w, Sample2d u) const {
    const Vec3f stretched = normalize(Vec3f{w.x * alpha, w.y * alpha, w.z});
    const SinCos phi = sin_cos_two_pi(u.x);
    const float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    const float r = safe_sqrt(1.0f - z * z);
    const Vec3f h = Vec3f{r * phi.cos, r * phi.sin, z} + stretched;
    return normalize(Vec3f{h.x * alpha, h.y * alpha, std::max(1e-6f, h.z)});
  }
};

inline Vec3f reflect(Vec3f w, Vec3f m) {
  return m * (2.0f * dot(w, m)) - w;
}

/// @param eta η_t/η_i; no total reflection
inline Vec3f refract(Vec3f w, Vec3f m, float eta) {
  const float cos_i = dot(w, m), cos_t = safe_sqrt(1.0f - (1.0f - sqr(cos_i)) / sqr(eta));
  return m * (cos_i / eta - cos_t) - w / eta;
}

/// dω_m/dω_i of refraction: Walter et al. 2007, equation 17. @param eta η_t/η_i
inline float refraction_jacobian(Vec3f wo, Vec3f wi, Vec3f m, float eta) {
  return std::abs(dot(wi, m)) / sqr(dot(wi, m) + dot(wo, m) / eta);
}

}  // namespace photopic
