#pragma once

#include "core/bsdf.h"
#include "core/fresnel.h"
#include "core/ggx_albedo.h"
#include "core/grazing_lobe.h"
#include "core/microfacet.h"

namespace photopic {

/// glTF 2.0's metallic-roughness model (appendix B) with KHR_materials_specular and _ior: a GGX reflection
/// with Schlick's Fresnel term over a diffuse base. Energy is conserved: bounces between microfacets are
/// given back after Kulla & Conty 2017 ("Revisiting Physically Based Shading at Imageworks"), and the base
/// receives just what the reflection leaves.
template <int N>
class OpaqueBsdf {
 public:
  static constexpr bool kTwoSided = true;
  static constexpr bool kLitFromBehind = false;

  OpaqueBsdf(const ShadingMaterial<N>& m, Vec3f wo)
      : wo_(wo), roughness_(m.roughness()), ggx_{sqr(roughness_)}, metallic_(m.opaque_metallic()) {
    const float ior = m.surface().ior, r0 = ior == 0.0f ? 1.0f : sqr((ior - 1.0f) / (ior + 1.0f));
    const float specular = m.specular();
    auto f0 = m.specular_color() * r0;
    for (int j = 0; j < N; ++j) f0.v[j] = std::min(f0.v[j], 1.0f);
    dielectric_ = {f0 * specular, SampledSpectrum<N>(specular)};
    const auto base = m.base_color();
    metal_ = {base, SampledSpectrum<N>(1.0f)};
    diffuse_ = base * (1.0f - metallic_);
    look();
  }

  BsdfValue<N> evaluate(Vec3f wi) const {
    if (wi.z <= 0.0f || wo_.z <= 0.0f) return {};
    BsdfValue<N> value{base(wi), diffuse_probability_ * cosine_hemisphere_pdf(wi.z)};
    if (grazing_probability_ > 0.0f) value.pdf += grazing_probability_ * grazing_.pdf(wi.z);
    if (mirror()) return value;
    const Vec3f m = normalize(wo_ + wi);
    const float d = ggx_.d(m) / (4.0f * wo_.z);
    value.f_cos += fresnel(dot(wo_, m)) * (d * ggx_.g2(wo_, wi));
    value.pdf += specular_probability_ * d * ggx_.g1(wo_);
    return value;
  }

  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const {
    if (wo_.z <= 0.0f) return {};
    const bool specular = u_lobe < specular_probability_;
    if (specular && mirror()) {
      const Vec3f wi{-wo_.x, -wo_.y, wo_.z};
      return BsdfSample<N>{wi, fresnel(wo_.z) / specular_probability_, 0.0f, true};
    }
    const bool grazing = u_lobe < specular_probability_ + grazing_probability_;
    const Vec3f wi = specular  ? reflect(wo_, ggx_.sample_visible(wo_, u))
                     : grazing ? grazing_.sample(u)
                               : sample_cosine_hemisphere(u);
    const BsdfValue<N> value = evaluate(wi);
    if (value.pdf == 0.0f) return {};
    return BsdfSample<N>{wi, value.f_cos / value.pdf, value.pdf, false};
  }

 private:
  struct Fresnel {
    SampledSpectrum<N> f0, f90;
    SampledSpectrum<N> albedo(GgxAlbedo::Factors f) const { return f0 * f.scale() + f90 * f.bias; }
    /// Kulla & Conty 2017, the colour of all further bounces; 1 where F is. @param e cosine-averaged factors
    SampledSpectrum<N> further_bounces(GgxAlbedo::Factors e) const {
      const SampledSpectrum<N> average = f0 * (20.0f / 21.0f) + f90 * (1.0f / 21.0f);  // of Schlick's term
      const SampledSpectrum<N> one(1.0f);
      return average * average * (1.0f - e.missing) / (one - average * e.missing);
    }
  };

  bool mirror() const { return ggx_.alpha < kSmoothAlpha; }

  SampledSpectrum<N> fresnel(float cos_theta) const {
    const float w = schlick_weight(cos_theta);
    return (metal_.f0 * (1.0f - w) + metal_.f90 * w) * metallic_ +
           (dielectric_.f0 * (1.0f - w) + dielectric_.f90 * w) * (1.0f - metallic_);
  }

  GgxAlbedo::Factors directional(float cos_theta) const {
    if (!mirror()) return GgxAlbedo::directional(cos_theta, roughness_);
    const float w = schlick_weight(cos_theta);
    return {0.0f, w};
  }
  GgxAlbedo::Factors average() const {
    if (!mirror()) return GgxAlbedo::average(roughness_);
    return {0.0f, 1.0f / 21.0f};
  }

  /// Share of light that a dielectric layer lets through from direction with these factors.
  SampledSpectrum<N> transmitted(GgxAlbedo::Factors directional, GgxAlbedo::Factors average) const {
    return SampledSpectrum<N>(1.0f) - dielectric_.albedo(directional) -
           dielectric_.further_bounces(average) * directional.missing;
  }

  /// What depends on wo alone.
  void look() {
    const GgxAlbedo::Factors e = directional(wo_.z);
    average_ = average();
    missing_ = e.missing;
    transmitted_ = transmitted(e, average_);
    const float specular = (metal_.albedo(e) * metallic_ + dielectric_.albedo(e) * (1.0f - metallic_)).sum();
    const float diffuse = (diffuse_ * transmitted_).sum(), further_sum = (further(average_) * missing_).sum();
    const float sum = specular + diffuse + further_sum;
    specular_probability_ = sum > 0.0f ? specular / sum : 1.0f;
    // A little of further bounces the cosine lobe serves as well.
    if (further_sum > 0.01f * diffuse)
      grazing_ = GrazingLobe(ggx_.alpha), grazing_probability_ = further_sum / sum;
    diffuse_probability_ = std::max(1.0f - specular_probability_ - grazing_probability_, 0.0f);
  }

  SampledSpectrum<N> further(GgxAlbedo::Factors average_e) const {
    return metal_.further_bounces(average_e) * metallic_ +
           dielectric_.further_bounces(average_e) * (1.0f - metallic_);
  }

  /// The diffuse base and the further bounces, both smooth; times cos θi.
  SampledSpectrum<N> base(Vec3f wi) const {
    const GgxAlbedo::Factors e = directional(wi.z);
    const SampledSpectrum<N> average_base = transmitted(average_, average_);
    SampledSpectrum<N> f{0.0f};
    for (int j = 0; j < N; ++j)
      if (average_base[j] > 0.0f) f.v[j] = diffuse_[j] * transmitted_[j] / average_base[j];
    f *= transmitted(e, average_);
    if (average_.missing > 0.0f) f += further(average_) * (missing_ * e.missing / average_.missing);
    return f * cosine_hemisphere_pdf(wi.z);
  }

  Vec3f wo_;
  float roughness_;
  Ggx ggx_;
  float metallic_;
  Fresnel dielectric_, metal_;
  SampledSpectrum<N> diffuse_;

  GgxAlbedo::Factors average_;                        ///< of the single bounce's albedo
  float missing_;                                     ///< 1 − E(wo), the share of further bounces
  SampledSpectrum<N> transmitted_;                    ///< into the base, of what comes from wo
  GrazingLobe grazing_;                               ///< of further bounces
  float specular_probability_, diffuse_probability_;  ///< of choosing the GGX lobe, the cosine
  float grazing_probability_ = 0.0f;                  ///< and, where further bounces matter, theirs
};

}  // namespace photopic
