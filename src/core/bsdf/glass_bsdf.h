#pragma once

#include "core/bsdf/bsdf.h"
#include "core/bsdf/fresnel.h"
#include "core/bsdf/further_glass.h"
#include "core/bsdf/microfacet.h"

namespace photopic {

/// glTF's transmission: a smooth or rough dielectric interface (Walter et al. 2007) with exact Fresnel terms.
/// Solid surfaces refract; thin walls reflect 2F/(1 + F), the sum over inner bounces, and let the rest pass
/// straight on. The base colour tints what passes. Radiance is carried: crossing scales it by 1/η². Light
/// that one bounce off the microsurface loses goes on to either side (FurtherGlass): no energy is lost, and
/// rough glass is reciprocal.
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
    if (is_delta() || wo_.z == 0.0f) return;
    g1_ = ggx_.g1(wo_);
    further_ = further(m);
  }

  /// Whether light comes from single directions alone, so that evaluate() has nothing.
  bool is_delta() const {
    return ggx_.alpha < kSmoothAlpha || (solid_ && ior_ != 0.0f && is_index_matched(ior_));
  }

  BsdfValue<N> evaluate(Vec3f wi) const {
    wi.z *= side_;
    if (is_delta() || wo_.z == 0.0f || wi.z == 0.0f) return {};
    if (wi.z > 0.0f) return with_further(evaluate_reflection(wi), wi);
    if (ior_ == 0.0f) return {};
    return with_further(solid_ ? evaluate_refraction(wi) : evaluate_passage(wi), wi);
  }

  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const {
    if (wo_.z == 0.0f) return {};
    if (u_lobe < further_.missing) return sample_further(u_lobe / further_.missing, u);
    u_lobe = std::min((u_lobe - further_.missing) / (1.0f - further_.missing), 0x1.fffffep-1f);
    const Vec3f m = is_delta() ? Vec3f{0, 0, 1} : ggx_.sample_visible(wo_, u);
    const float f = reflectance(dot(wo_, m));

    BsdfSample<N> s;
    s.delta = is_delta();
    const bool reflected = u_lobe < f;
    if (reflected || !solid_) {
      s.wi = reflect(wo_, m);
      if (s.wi.z <= 0.0f) return {};
      s.weight = reflected ? SampledSpectrum<N>(1.0f) : tint_;
      if (!s.delta) {
        s.pdf = (reflected ? f : 1.0f - f) * visible_pdf(m) / (4.0f * dot(wo_, m));
        s.weight *= ggx_.g2(wo_, s.wi) / g1_;
      }
      if (!reflected) s.wi.z = -s.wi.z, s.straight = s.delta;
    } else {
      s.wi = refract(wo_, m, eta_);
      if (s.wi.z >= 0.0f) return {};
      s.weight = tint_ / sqr(eta_);
      s.eta = eta_;
      if (!s.delta) {
        s.pdf = (1.0f - f) * visible_pdf(m) * refraction_jacobian(wo_, s.wi, m, eta_);
        s.weight *= ggx_.g2(wo_, s.wi) / g1_;
      }
    }
    if (!s.delta) {
      const BsdfValue<N> value = with_further({s.weight * s.pdf, s.pdf}, s.wi);
      if (value.pdf == 0.0f) return {};
      s.pdf = value.pdf, s.weight = value.f_cos / value.pdf;
    }
    s.wi.z *= side_;
    return s;
  }

 private:
  float reflectance(float cos_i) const {
    if (ior_ == 0.0f) return 1.0f;
    const float f = specular_.scaled(fresnel_dielectric(cos_i, eta_), cos_i, eta_);
    return solid_ ? f : 2.0f * f / (1.0f + f);
  }

  FurtherGlass further(const ShadingMaterial<N>& m) const {
    if (!solid_ || ior_ == 0.0f)
      return FurtherGlass::of_thin_wall(wo_.z, m.roughness(), reflectance(FurtherGlass::kMeanCosine));
    const auto& albedo = m.surface().glass_albedo;  // none where nothing was foreseen to be refracted
    if (!albedo) return {};
    return FurtherGlass::of_solid(*albedo, wo_.z, m.roughness(), eta_, {specular_, {}});
  }

  /// Adds further bounces to one bounce's value; densities are shared out. wi as wo_ stands.
  BsdfValue<N> with_further(BsdfValue<N> one, Vec3f wi) const {
    const float f_cos = further_.f_cos(wi.z);
    one.f_cos += wi.z > 0.0f ? SampledSpectrum<N>(f_cos) : tint_ * f_cos;
    one.pdf = (1.0f - further_.missing) * one.pdf + further_.missing * further_.pdf(wi.z);
    return one;
  }

  std::optional<BsdfSample<N>> sample_further(float u_side, Sample2d u) const {
    Vec3f wi = further_.sample(u_side, u);
    const bool crosses = wi.z < 0.0f;
    wi.z *= side_;
    const BsdfValue<N> value = evaluate(wi);
    if (value.pdf == 0.0f) return {};
    return BsdfSample<N>{wi, value.f_cos / value.pdf, value.pdf, false, crosses && solid_ ? eta_ : 1.0f};
  }

  /// Of normals seen from wo: Ggx::visible_pdf.
  float visible_pdf(Vec3f m) const { return g1_ * ggx_.d(m) * std::max(0.0f, dot(wo_, m)) / wo_.z; }

  BsdfValue<N> evaluate_reflection(Vec3f wi) const {
    const Vec3f m = normalize(wo_ + wi);
    const float f = reflectance(dot(wo_, m)), d = ggx_.d(m) / (4.0f * wo_.z);
    return {SampledSpectrum<N>(f * d * ggx_.g2(wo_, wi)), f * d * g1_};
  }

  /// Thin walls: the reflection's lobe, mirrored to the other side.
  BsdfValue<N> evaluate_passage(Vec3f wi) const {
    wi.z = -wi.z;
    const Vec3f m = normalize(wo_ + wi);
    const float f = 1.0f - reflectance(dot(wo_, m)), d = ggx_.d(m) / (4.0f * wo_.z);
    return {tint_ * (f * d * ggx_.g2(wo_, wi)), f * d * g1_};
  }

  BsdfValue<N> evaluate_refraction(Vec3f wi) const {
    Vec3f m = normalize(wo_ + wi * eta_);
    if (m.z < 0.0f) m = -m;
    const float cos_o = dot(wo_, m);
    if (cos_o <= 0.0f || dot(wi, m) >= 0.0f) return {};
    const float passed = 1.0f - reflectance(cos_o);
    const float common = passed * ggx_.d(m) * cos_o / wo_.z * refraction_jacobian(wo_, wi, m, eta_);
    return {tint_ * (common * ggx_.g2(wo_, wi) / sqr(eta_)), common * g1_};
  }

  float side_;  ///< −1 where wo is below; all else is mirrored to have it above
  Vec3f wo_;
  Ggx ggx_;
  bool solid_;
  float ior_;  ///< of the glass, over that of the medium in front of it
  float eta_;  ///< η_t/η_i
  SpecularScale specular_;
  SampledSpectrum<N> tint_;
  float g1_ = 1.0f;  ///< of wo
  FurtherGlass further_;
};

}  // namespace photopic
