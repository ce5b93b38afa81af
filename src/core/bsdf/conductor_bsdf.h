#pragma once

#include "core/bsdf/bsdf.h"
#include "core/bsdf/grazing_lobe.h"
#include "core/bsdf/microfacet.h"
#include "core/bsdf/spectral_fresnel.h"

namespace photopic {

/// A metal of known complex index: GGX with the exact Fresnel term at every wavelength, further bounces given
/// back after Kulla & Conty 2017.
template <int N>
class ConductorBsdf {
 public:
  static constexpr bool kTwoSided = true;
  static constexpr bool kLitFromBehind = false;

  ConductorBsdf(const ShadingMaterial<N>& m, Vec3f wo)
      : wo_(wo), ggx_{sqr(m.roughness())}, fresnel_(measured(m)) {
    if (is_delta() || wo.z <= 0.0f) return;
    const FresnelAlbedo& table = FresnelAlbedo::table();
    const FresnelAlbedo::Weights e = table.directional(wo.z, m.roughness());
    const FresnelAlbedo::Weights average = table.average(m.roughness());
    roughness_ = m.roughness();
    g1_ = ggx_.g1(wo);
    grazing_ = GrazingLobe(ggx_.alpha);
    further_ = fresnel_.further_bounces(average) * (e.missing / average.missing);
    const float bounce = fresnel_.albedo(e).sum();
    const float further = fresnel_.further_bounces(average).sum() * e.missing;
    bounce_probability_ = bounce / (bounce + further);
  }

  /// The exact Fresnel term of the surface's metal, in the medium that lies in front.
  static SpectralFresnel<N> measured(const ShadingMaterial<N>& m) {
    const ConductorIndex& index = *m.surface().extensions->conductor;
    SampledSpectrum<N> n, k;
    for (int j = 0; j < N; ++j) {
      n.v[j] = static_cast<float>(index.n(m.lambda()[j]));
      k.v[j] = static_cast<float>(index.k(m.lambda()[j]));
    }
    if (m.in_vacuum()) return SpectralFresnel<N>::conductor(n, k);
    const SampledSpectrum<N> outside = m.outside_indices();
    return SpectralFresnel<N>::conductor(n / outside, k / outside);
  }

  /// Whether light comes from single directions alone, so that evaluate() has nothing.
  bool is_delta() const { return ggx_.alpha < kSmoothAlpha; }

  BsdfValue<N> evaluate(Vec3f wi) const {
    if (wi.z <= 0.0f || wo_.z <= 0.0f || is_delta()) return {};
    const Vec3f m = normalize(wo_ + wi);
    const float d = ggx_.d(m) / (4.0f * wo_.z), cosine = cosine_hemisphere_pdf(wi.z);
    const float missing = FresnelAlbedo::table().directional(wi.z, roughness_).missing;
    return {fresnel_(dot(wo_, m)) * (d * ggx_.g2(wo_, wi)) + further_ * (missing * cosine),
            bounce_probability_ * d * g1_ + (1.0f - bounce_probability_) * grazing_.pdf(wi.z)};
  }

  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const {
    if (wo_.z <= 0.0f) return {};
    if (is_delta()) return BsdfSample<N>{{-wo_.x, -wo_.y, wo_.z}, fresnel_(wo_.z), 0.0f, true};
    const Vec3f wi =
        u_lobe < bounce_probability_ ? reflect(wo_, ggx_.sample_visible(wo_, u)) : grazing_.sample(u);
    const BsdfValue<N> value = evaluate(wi);
    if (value.pdf == 0.0f) return {};
    return BsdfSample<N>{wi, value.f_cos / value.pdf, value.pdf, false};
  }

 private:
  Vec3f wo_;
  Ggx ggx_;
  GrazingLobe grazing_;
  FresnelFit<N> fresnel_;
  float roughness_ = 0.0f;
  float g1_ = 1.0f;                   ///< of wo
  SampledSpectrum<N> further_{0.0f};  ///< further bounces, but for the factor that depends on wi
  float bounce_probability_ = 1.0f;   ///< of choosing the GGX lobe
};

}  // namespace photopic
