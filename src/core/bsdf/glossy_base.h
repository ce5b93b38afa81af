#pragma once

#include "core/bsdf/bsdf.h"
#include "core/bsdf/conductor_bsdf.h"
#include "core/bsdf/grain_albedo.h"
#include "core/bsdf/grazing_lobe.h"
#include "core/bsdf/spectral_fresnel.h"

namespace photopic {

/// What lies under the coats of a LayeredBsdf: OpaqueBsdf's model with, besides, roughness that depends on
/// the direction (KHR_materials_anisotropy; x is the rougher), a thin film (KHR_materials_iridescence), a
/// metal of known index, and a diffuse base that lets light through (KHR_materials_diffuse_transmission).
template <int N>
class GlossyBase {
 public:
  GlossyBase(const ShadingMaterial<N>& m, Vec3f wo) : roughness_(m.roughness()) {
    const MaterialExtensions& x = *m.surface().extensions;
    const auto grain = m.grain();
    strength_ = grain.strength;
    cos_turn_ = std::cos(grain.rotation), sin_turn_ = std::sin(grain.rotation);
    ggx_ = AnisotropicGgx::of(roughness_, strength_);
    if (strength_ > 0.0f) grain_ = GrainAlbedo(ggx_);
    wo_ = to_grain(wo);
    set_colors(m, x);
    if (wo.z > 0.0f) look();
  }

  /// Of light from all around, about: what it weighs among layers.
  SampledSpectrum<N> albedo() const { return specular_ + diffuse_albedo(); }

  BsdfValue<N> evaluate(Vec3f wi) const {
    wi = to_grain(wi);
    if (wi.z == 0.0f || wo_.z <= 0.0f) return {};
    const FresnelAlbedo::Weights e = directional({wi.x, wi.y, std::abs(wi.z)});
    const float cosine = cosine_hemisphere_pdf(std::abs(wi.z));
    const SampledSpectrum<N> through = transmitted(e) * base_gain_ * cosine;
    if (wi.z < 0.0f) return {passed_ * through, p_through_ * cosine};

    BsdfValue<N> value{reflected_ * through + further_ * (e.missing * cosine), p_diffuse_ * cosine};
    if (mirror()) return value;
    value.pdf += p_grazing_ * grazing_.pdf(wi.z);
    const Vec3f m = normalize(wo_ + wi);
    const float d = ggx_.d(m) / (4.0f * wo_.z);
    value.f_cos += fresnel(dot(wo_, m)) * (d * ggx_.g2(wo_, wi));
    value.pdf += p_specular_ * d * ggx_.g1(wo_);
    return value;
  }

  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const {
    if (wo_.z <= 0.0f) return {};
    Vec3f wi;
    if (u_lobe < p_specular_) {
      if (mirror())
        return BsdfSample<N>{from_grain({-wo_.x, -wo_.y, wo_.z}), fresnel(wo_.z) / p_specular_, 0.0f, true};
      wi = reflect(wo_, ggx_.sample_visible(wo_, u));
      if (wi.z <= 0.0f) return {};
    } else if (u_lobe < p_specular_ + p_grazing_) {
      wi = grazing_.sample(u);
    } else {
      wi = sample_cosine_hemisphere(u);
      if (u_lobe < p_specular_ + p_grazing_ + p_through_) wi.z = -wi.z;
    }
    wi = from_grain(wi);
    const BsdfValue<N> value = evaluate(wi);
    if (value.pdf == 0.0f) return {};
    return BsdfSample<N>{wi, value.f_cos / value.pdf, value.pdf, false};
  }

 private:
  bool mirror() const { return strength_ == 0.0f && ggx_.alpha_x < kSmoothAlpha; }

  Vec3f to_grain(Vec3f w) const {
    return {w.x * cos_turn_ + w.y * sin_turn_, w.y * cos_turn_ - w.x * sin_turn_, w.z};
  }
  Vec3f from_grain(Vec3f w) const {
    return {w.x * cos_turn_ - w.y * sin_turn_, w.y * cos_turn_ + w.x * sin_turn_, w.z};
  }

  void set_colors(const ShadingMaterial<N>& m, const MaterialExtensions& x) {
    metallic_ = x.conductor ? 1.0f : m.opaque_metallic();
    const SampledSpectrum<N> specular(m.specular()), base = m.base_color();
    auto dielectric = SpectralFresnel<N>::schlick(at_most_1(m.dielectric_f0()) * specular, specular);
    auto metal = x.conductor ? ConductorBsdf<N>::measured(m)
                             : SpectralFresnel<N>::schlick(base, SampledSpectrum<N>(1.0f));
    if (x.iridescence > 0.0f) {
      SurfaceFilm<N> film{m.iridescence(), x.iridescence_ior};
      film.phase = SampledSpectrum<N>(2.0f * kPi * m.film_thickness()) / m.lambda();
      film.outside = m.outside_indices();
      dielectric.put_on(film), metal.put_on(film);
    }
    if (metallic_ < 1.0f) dielectric_ = FresnelFit<N>(dielectric);
    if (metallic_ > 0.0f) metal_ = FresnelFit<N>(metal);
    const float diffuse = 1.0f - metallic_;
    const float through = m.diffuse_transmission();
    reflected_ = base * (diffuse * (1.0f - through));
    passed_ = m.diffuse_transmission_color() * (diffuse * through);
  }

  /// What depends on wo alone.
  void look() {
    const FresnelAlbedo::Weights e = directional(wo_);
    average_ = average();
    if (metallic_ > 0.0f) further_ = metal_.further_bounces(average_) * metallic_;
    if (metallic_ < 1.0f) {
      dielectric_further_ = dielectric_.further_bounces(average_);
      further_ += dielectric_further_ * (1.0f - metallic_);
    }
    const SampledSpectrum<N> single =
        metal_.albedo(e) * metallic_ + dielectric_.albedo(e) * (1.0f - metallic_);
    specular_ = single + further_ * e.missing;
    further_ *= average_.missing > 0.0f ? e.missing / average_.missing : 0.0f;
    from_wo_ = transmitted(e);
    base_gain_ = share(from_wo_, transmitted(average_));

    grazing_ = GrazingLobe(std::max(ggx_.alpha_x, kSmoothAlpha));
    const float sum = (diffuse_albedo() + specular_).sum();
    p_specular_ = sum > 0.0f ? single.sum() / sum : 1.0f;
    p_grazing_ = sum > 0.0f ? (specular_ - single).sum() / sum : 0.0f;
    p_through_ = sum > 0.0f ? (passed_ * from_wo_).sum() / sum : 0.0f;
    p_diffuse_ = std::max(1.0f - p_specular_ - p_grazing_ - p_through_, 0.0f);
  }

  SampledSpectrum<N> diffuse_albedo() const { return (reflected_ + passed_) * from_wo_; }

  SampledSpectrum<N> fresnel(float cos_theta) const {
    if (metallic_ == 1.0f) return metal_(cos_theta);
    if (metallic_ == 0.0f) return dielectric_.fitted(cos_theta);
    return metal_(cos_theta) * metallic_ + dielectric_.fitted(cos_theta) * (1.0f - metallic_);
  }

  FresnelAlbedo::Weights directional(Vec3f w) const {
    if (mirror()) return FresnelAlbedo::at(w.z);
    return strength_ > 0.0f ? grain_.directional(w, dielectric_.has_rest() || metal_.has_rest())
                            : FresnelAlbedo::table().directional(w.z, roughness_);
  }
  FresnelAlbedo::Weights average() const {
    if (mirror()) return FresnelFit<N>::smooth_average();
    return strength_ > 0.0f ? grain_.average() : FresnelAlbedo::table().average(roughness_);
  }

  /// Share of light that the dielectric surface lets through to the diffuse base.
  SampledSpectrum<N> transmitted(const FresnelAlbedo::Weights& e) const {
    SampledSpectrum<N> share =
        SampledSpectrum<N>(1.0f) - dielectric_.albedo(e) - dielectric_further_ * e.missing;
    for (int j = 0; j < N; ++j) share.v[j] = std::max(share[j], 0.0f);
    return share;
  }

  float roughness_, strength_;
  float cos_turn_, sin_turn_;  ///< the grain's direction in the shading frame
  AnisotropicGgx ggx_;
  GrainAlbedo grain_;  ///< of no surface where nothing is brushed
  Vec3f wo_;           ///< in the grain's frame, as are all directions in private functions
  float metallic_;
  FresnelFit<N> dielectric_, metal_;
  SampledSpectrum<N> reflected_, passed_;  ///< the diffuse base's colours

  FresnelAlbedo::Weights average_;
  SampledSpectrum<N> specular_{0.0f};  ///< albedo of the surface, further bounces included
  SampledSpectrum<N> further_{0.0f};   ///< further bounces, but for the factor that depends on wi
  SampledSpectrum<N> dielectric_further_{0.0f};
  SampledSpectrum<N> from_wo_{0.0f};            ///< transmitted from wo
  SampledSpectrum<N> base_gain_{0.0f};          ///< transmitted from wo over the mean of all directions
  GrazingLobe grazing_;                         ///< of further bounces
  float p_specular_ = 1.0f, p_grazing_ = 0.0f;  ///< of choosing the GGX lobe, further bounces,
  float p_diffuse_ = 0.0f, p_through_ = 0.0f;   ///< the base's reflection and passage
};

}  // namespace photopic
