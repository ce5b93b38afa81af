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
template <typename T>
struct BasicGgx {
  T alpha;  ///< roughness², > 0

  /// D(m) [1/sr]; the form with sin²/α² keeps small α accurate.
  T d(Vec3<T> m) const {
    const T k = (m.x * m.x + m.y * m.y) / sqr(alpha) + m.z * m.z;
    return select(m.z <= 0.0f, T{}, kInvPi / (sqr(alpha) * k * k));
  }

  T lambda(Vec3<T> w) const {
    const T tan2 = (w.x * w.x + w.y * w.y) / sqr(w.z);
    return 0.5f * (sqrt(1.0f + sqr(alpha) * tan2) - 1.0f);
  }
  /// Smith masking, and height-correlated masking-shadowing: Heitz 2014, equations 43 and 99.
  T g1(Vec3<T> w) const { return 1.0f / (1.0f + lambda(w)); }
  T g2(Vec3<T> wo, Vec3<T> wi) const { return 1.0f / (1.0f + lambda(wo) + lambda(wi)); }

  /// The density of the normals seen from w, w.z > 0 [1/sr]: Heitz & d'Eon 2014, equation 2.
  T visible_pdf(Vec3<T> w, Vec3<T> m) const { return g1(w) * d(m) * max(T{}, dot(w, m)) / w.z; }

  /// A normal seen from w, w.z > 0: spherical caps, Dupuy & Benyoub 2023.
  Vec3<T> sample_visible(Vec3<T> w, BasicSample2d<T> u) const {
    const Vec3<T> stretched = normalize(Vec3<T>{w.x * alpha, w.y * alpha, w.z});
    const auto phi = sin_cos_two_pi(u.x);
    const T z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    const T r = safe_sqrt(1.0f - z * z);
    const Vec3<T> h = Vec3<T>{r * phi.cos, r * phi.sin, z} + stretched;
    return normalize(Vec3<T>{h.x * alpha, h.y * alpha, max(T{} + 1e-6f, h.z)});
  }
};
using Ggx = BasicGgx<float>;

template <typename T>
Vec3<T> reflect(Vec3<T> w, Vec3<T> m) {
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
