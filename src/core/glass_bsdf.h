#pragma once

#include "core/bsdf.h"
#include "core/fresnel.h"
#include "core/microfacet.h"

namespace photopic {

/// glTF's transmission: a smooth or rough dielectric interface (Walter et al. 2007) with exact Fresnel terms.
/// Solid surfaces refract; thin walls reflect 2F/(1 + F), the sum over inner bounces, and let the rest pass
/// straight on. The base colour tints what passes. Radiance is carried: crossing scales it by 1/η².
template <int N>
class GlassBsdf {
 public:
  static constexpr bool kTwoSided = false;

  explicit GlassBsdf(const ShadingMaterial<N>& m)
      : ggx_{sqr(m.roughness())}, ior_(m.surface().ior), solid_(m.surface().solid), tint_(m.base_color()) {}

  BsdfValue<N> evaluate(Vec3f wo, Vec3f wi) const {
    if (smooth() || wo.z == 0.0f || wi.z == 0.0f) return {};
    const float eta = crossing_eta(wo);
    if (wo.z < 0.0f) wo.z = -wo.z, wi.z = -wi.z;
    if (wi.z > 0.0f) return evaluate_reflection(wo, wi, eta);
    if (ior_ == 0.0f) return {};
    return solid_ ? evaluate_refraction(wo, wi, eta) : evaluate_passage(wo, wi, eta);
  }

  std::optional<BsdfSample<N>> sample(Vec3f wo, float u_lobe, Sample2d u) const {
    if (wo.z == 0.0f) return {};
    const float side = wo.z < 0.0f ? -1.0f : 1.0f;
    const float eta = crossing_eta(wo);
    wo.z *= side;
    const Vec3f m = smooth() ? Vec3f{0, 0, 1} : ggx_.sample_visible(wo, u);
    const float f = reflectance(dot(wo, m), eta);

    BsdfSample<N> s;
    s.delta = smooth();
    const bool reflected = u_lobe < f;
    if (reflected || !solid_) {
      s.wi = reflect(wo, m);
      if (s.wi.z <= 0.0f) return {};
      s.weight = reflected ? SampledSpectrum<N>(1.0f) : tint_;
      if (!reflected) s.wi.z = -s.wi.z;
      s.pdf = (reflected ? f : 1.0f - f) * ggx_.visible_pdf(wo, m) / (4.0f * dot(wo, m));
    } else {
      const float cos_i = dot(wo, m), cos_t = safe_sqrt(1.0f - (1.0f - sqr(cos_i)) / sqr(eta));
      s.wi = m * (cos_i / eta - cos_t) - wo / eta;
      if (s.wi.z >= 0.0f) return {};
      s.weight = tint_ / sqr(eta);
      s.eta = eta;
      s.pdf = (1.0f - f) * ggx_.visible_pdf(wo, m) * refraction_jacobian(wo, s.wi, m, eta);
    }
    if (!s.delta) {
      s.weight *= ggx_.g2(wo, s.wi) / ggx_.g1(wo);
      if (s.pdf == 0.0f) return {};
    }
    s.wi.z *= side;
    return s;
  }

 private:
  /// Without a change of index refraction has no half vector: rough or not, light goes straight on.
  bool smooth() const { return ggx_.alpha < kSmoothAlpha || (solid_ && std::abs(ior_ - 1.0f) < 1e-4f); }

  float crossing_eta(Vec3f wo) const { return !solid_ || wo.z > 0.0f ? ior_ : 1.0f / ior_; }

  float reflectance(float cos_i, float eta) const {
    if (ior_ == 0.0f) return 1.0f;
    const float f = fresnel_dielectric(cos_i, eta);
    return solid_ ? f : 2.0f * f / (1.0f + f);
  }

  /// dω_m/dω_i: Walter et al. 2007, equation 17.
  static float refraction_jacobian(Vec3f wo, Vec3f wi, Vec3f m, float eta) {
    return std::abs(dot(wi, m)) / sqr(dot(wi, m) + dot(wo, m) / eta);
  }

  BsdfValue<N> evaluate_reflection(Vec3f wo, Vec3f wi, float eta) const {
    const Vec3f m = normalize(wo + wi);
    const float f = reflectance(dot(wo, m), eta), d = ggx_.d(m) / (4.0f * wo.z);
    return {SampledSpectrum<N>(f * d * ggx_.g2(wo, wi)), f * d * ggx_.g1(wo)};
  }

  /// Thin walls: the reflection's lobe, mirrored to the other side.
  BsdfValue<N> evaluate_passage(Vec3f wo, Vec3f wi, float eta) const {
    wi.z = -wi.z;
    const Vec3f m = normalize(wo + wi);
    const float f = 1.0f - reflectance(dot(wo, m), eta), d = ggx_.d(m) / (4.0f * wo.z);
    return {tint_ * (f * d * ggx_.g2(wo, wi)), f * d * ggx_.g1(wo)};
  }

  BsdfValue<N> evaluate_refraction(Vec3f wo, Vec3f wi, float eta) const {
    Vec3f m = normalize(wo + wi * eta);
    if (m.z < 0.0f) m = -m;
    const float cos_o = dot(wo, m);
    if (cos_o <= 0.0f || dot(wi, m) >= 0.0f) return {};
    const float passed = 1.0f - reflectance(cos_o, eta);
    const float common = passed * ggx_.d(m) * cos_o / wo.z * refraction_jacobian(wo, wi, m, eta);
    return {tint_ * (common * ggx_.g2(wo, wi) / sqr(eta)), common * ggx_.g1(wo)};
  }

  Ggx ggx_;
  float ior_;
  bool solid_;
  SampledSpectrum<N> tint_;
};

}  // namespace photopic
