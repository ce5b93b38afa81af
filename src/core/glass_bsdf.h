#pragma once

#include "core/bsdf.h"
#include "core/fresnel.h"
#include "core/ggx_albedo.h"
#include "core/microfacet.h"

namespace photopic {

/// glTF's transmission: a smooth or rough dielectric interface (Walter et al. 2007) with exact Fresnel terms.
/// Solid surfaces refract; thin walls reflect 2F/(1 + F), the sum over inner bounces, and let the rest pass
/// straight on. The base colour tints what passes. Radiance is carried: crossing scales it by 1/η². Light
/// that one bounce off the microsurface loses is given back in proportion (Turquin 2019): no energy is lost,
/// and rough glass is reciprocal but for that factor, which depends on wo.
template <int N>
class GlassBsdf {
 public:
  static constexpr bool kTwoSided = false;
  static constexpr bool kLitFromBehind = true;

  GlassBsdf(const ShadingMaterial<N>& m, Vec3f wo)
      : side_(wo.z < 0.0f ? -1.0f : 1.0f),
        wo_{wo.x, wo.y, wo.z * side_},
        ggx_{sqr(m.roughness())},
        solid_(m.surface().solid),
        ior_(solid_ ? m.surface().ior / m.outside_index(m.lambda()[0]) : m.surface().ior),
        eta_(!solid_ || side_ > 0.0f ? ior_ : 1.0f / ior_),
        specular_{m.specular(), m.specular()},
        tint_(m.base_color()) {
    if (!smooth() && wo_.z > 0.0f) g1_ = ggx_.g1(wo_), gain_ = 1.0f / kept(m);
  }

  BsdfValue<N> evaluate(Vec3f wi) const {
    wi.z *= side_;
    if (smooth() || wo_.z == 0.0f || wi.z == 0.0f) return {};
    if (wi.z > 0.0f) return evaluate_reflection(wi);
    if (ior_ == 0.0f) return {};
    return solid_ ? evaluate_refraction(wi) : evaluate_passage(wi);
  }

  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const {
    if (wo_.z == 0.0f) return {};
    const Vec3f m = smooth() ? Vec3f{0, 0, 1} : ggx_.sample_visible(wo_, u);
    const float f = reflectance(dot(wo_, m));

    BsdfSample<N> s;
    s.delta = smooth();
    const bool reflected = u_lobe < f;
    if (reflected || !solid_) {
      s.wi = reflect(wo_, m);
      if (s.wi.z <= 0.0f) return {};
      s.weight = reflected ? SampledSpectrum<N>(1.0f) : tint_;
      if (!s.delta) {
        s.pdf = (reflected ? f : 1.0f - f) * visible_pdf(m) / (4.0f * dot(wo_, m));
        s.weight *= gain_ * ggx_.g2(wo_, s.wi) / g1_;
      }
      if (!reflected) s.wi.z = -s.wi.z;
    } else {
      s.wi = refract(wo_, m, eta_);
      if (s.wi.z >= 0.0f) return {};
      s.weight = tint_ / sqr(eta_);
      s.eta = eta_;
      if (!s.delta) {
        s.pdf = (1.0f - f) * visible_pdf(m) * refraction_jacobian(wo_, s.wi, m, eta_);
        s.weight *= gain_ * ggx_.g2(wo_, s.wi) / g1_;
      }
    }
    if (!s.delta && s.pdf == 0.0f) return {};
    s.wi.z *= side_;
    return s;
  }

 private:
  bool smooth() const {
    return ggx_.alpha < kSmoothAlpha || (solid_ && ior_ != 0.0f && is_index_matched(ior_));
  }

  float reflectance(float cos_i) const {
    if (ior_ == 0.0f) return 1.0f;
    const float f = specular_.scaled(fresnel_dielectric(cos_i, eta_), cos_i, eta_);
    return solid_ ? f : 2.0f * f / (1.0f + f);
  }

  /// The share that one bounce keeps; what passes a thin wall keeps what reflection does.
  float kept(const ShadingMaterial<N>& m) const {
    if (!solid_ || ior_ == 0.0f) return 1.0f - GgxAlbedo::table().directional(wo_.z, m.roughness()).missing;
    return (*m.surface().glass_albedo)(wo_.z, m.roughness(), eta_, {specular_});
  }

  /// Of normals seen from wo: Ggx::visible_pdf.
  float visible_pdf(Vec3f m) const { return g1_ * ggx_.d(m) * std::max(0.0f, dot(wo_, m)) / wo_.z; }

  BsdfValue<N> evaluate_reflection(Vec3f wi) const {
    const Vec3f m = normalize(wo_ + wi);
    const float f = reflectance(dot(wo_, m)), d = ggx_.d(m) / (4.0f * wo_.z);
    return {SampledSpectrum<N>(f * d * gain_ * ggx_.g2(wo_, wi)), f * d * g1_};
  }

  /// Thin walls: the reflection's lobe, mirrored to the other side.
  BsdfValue<N> evaluate_passage(Vec3f wi) const {
    wi.z = -wi.z;
    const Vec3f m = normalize(wo_ + wi);
    const float f = 1.0f - reflectance(dot(wo_, m)), d = ggx_.d(m) / (4.0f * wo_.z);
    return {tint_ * (f * d * gain_ * ggx_.g2(wo_, wi)), f * d * g1_};
  }

  BsdfValue<N> evaluate_refraction(Vec3f wi) const {
    Vec3f m = normalize(wo_ + wi * eta_);
    if (m.z < 0.0f) m = -m;
    const float cos_o = dot(wo_, m);
    if (cos_o <= 0.0f || dot(wi, m) >= 0.0f) return {};
    const float passed = 1.0f - reflectance(cos_o);
    const float common = passed * ggx_.d(m) * cos_o / wo_.z * refraction_jacobian(wo_, wi, m, eta_);
    return {tint_ * (common * gain_ * ggx_.g2(wo_, wi) / sqr(eta_)), common * g1_};
  }

  float side_;  ///< −1 where wo is below; all else is mirrored to have it above
  Vec3f wo_;
  Ggx ggx_;
  bool solid_;
  float ior_;  ///< of the glass, over that of the medium in front of it
  float eta_;  ///< η_t/η_i
  SpecularScale specular_;
  SampledSpectrum<N> tint_;
  float g1_ = 1.0f;    ///< of wo
  float gain_ = 1.0f;  ///< 1/(share that one bounce keeps)
};

}  // namespace photopic
