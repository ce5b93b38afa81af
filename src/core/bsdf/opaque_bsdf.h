#pragma once

#include "core/bsdf/bsdf.h"
#include "core/bsdf/fresnel.h"
#include "core/bsdf/ggx_albedo.h"
#include "core/bsdf/grazing_lobe.h"
#include "core/bsdf/microfacet.h"
#include "core/spectrum_lanes.h"

namespace photopic {

/// What a hit's material comes to, of one path or of 16.
template <int N, typename T>
struct OpaqueMaterial {
  SpectrumOf<N, T> base;
  SpectrumOf<N, T> f0;  ///< the dielectric's: ShadingMaterial::dielectric_f0
  T roughness;          ///< perceptual
  T metallic, specular;
};

template <int N>
OpaqueMaterial<N, float> opaque_material(const ShadingMaterial<N>& m) {
  return {.base = m.base_color(),
          .f0 = m.dielectric_f0(),
          .roughness = m.roughness(),
          .metallic = m.opaque_metallic(),
          .specular = m.specular()};
}

/// glTF 2.0's metallic-roughness model (appendix B) with KHR_materials_specular and _ior: a GGX reflection
/// with Schlick's Fresnel term over a diffuse base. Energy is conserved: bounces between microfacets are
/// given back after Kulla & Conty 2017 ("Revisiting Physically Based Shading at Imageworks"), and the base
/// receives just what the reflection leaves.
template <int N, typename T>
class BasicOpaqueBsdf {
 public:
  static constexpr bool kTwoSided = true;
  static constexpr bool kLitFromBehind = false;

  BasicOpaqueBsdf(const OpaqueMaterial<N, T>& m, const Vec3<T>& wo)
      : wo_(wo), roughness_(m.roughness), ggx_{sqr(m.roughness)}, metallic_(m.metallic) {
    dielectric_ = {at_most_1(m.f0) * m.specular, Spectrum(m.specular)};
    metal_ = {m.base, Spectrum(1.0f)};
    diffuse_ = m.base * (1.0f - metallic_);
    look();
  }
  BasicOpaqueBsdf(const ShadingMaterial<N>& m, Vec3f wo) : BasicOpaqueBsdf(opaque_material(m), wo) {}

  BasicBsdfValue<N, T> evaluate(const Vec3<T>& wi) const {
    BasicBsdfValue<N, T> value{base(wi), diffuse_probability_ * cosine_hemisphere_pdf(wi.z)};
    if (any(grazing_probability_ > 0.0f)) value.pdf += grazing_probability_ * grazing_.pdf(wi.z);
    const Vec3<T> m = normalize(wo_ + wi);
    const T d = select(mirror(), T{}, ggx_.d(m) / (4.0f * wo_.z));
    value.f_cos += fresnel(dot(wo_, m)) * select(mirror(), T{}, d * ggx_.g2(wo_, wi));
    value.pdf += select(mirror(), T{}, specular_probability_ * d * ggx_.g1(wo_));
    const auto below =
        (wi.z <= 0.0f) | (wo_.z <= 0.0f);  // what is not a number is neither, and stays to be seen
    return {select(below, Spectrum(0.0f), value.f_cos), select(below, T{}, value.pdf)};
  }

  BsdfDraw<N, T> draw(T u_lobe, BasicSample2d<T> u) const {
    const auto specular = u_lobe < specular_probability_;
    const auto grazing =
        (u_lobe >= specular_probability_) & (u_lobe < specular_probability_ + grazing_probability_);
    Vec3<T> wi = sample_cosine_hemisphere(u);
    if (any(specular)) {
      const Vec3<T> m = ggx_.sample_visible(wo_, u), mirrored{-wo_.x, -wo_.y, wo_.z};
      wi = select(specular, select(mirror(), mirrored, reflect(wo_, m)), wi);
    }
    for_each_lane(grazing, [&](int i) { set_lane(wi, i, lane(grazing_, i).sample(lane(u, i))); });
    const BasicBsdfValue<N, T> value = evaluate(wi);
    const Mask<T> delta = specular & mirror() & (wo_.z > 0.0f), found = delta | (value.pdf != 0.0f);
    const Spectrum weight = value.f_cos / value.pdf, of_delta = fresnel(wo_.z) / specular_probability_;
    return {.wi = wi,
            .weight = select(delta, of_delta, weight),
            .pdf = value.pdf,
            .delta = delta,
            .found = found};
  }
  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const { return draw(u_lobe, u).sample(); }

 private:
  using Spectrum = SpectrumOf<N, T>;
  using Factors = GgxAlbedo::BasicFactors<T>;

  struct Fresnel {
    Spectrum f0, f90;
    Spectrum albedo(const Factors& f) const { return f0 * f.scale() + f90 * f.bias; }
    /// Kulla & Conty 2017, the colour of all further bounces; 1 where F is. @param e cosine-averaged factors
    Spectrum further_bounces(const Factors& e) const {
      const Spectrum average = f0 * (20.0f / 21.0f) + f90 * (1.0f / 21.0f);  // of Schlick's term
      return average * average * (1.0f - e.missing) / (Spectrum(1.0f) - average * e.missing);
    }
  };

  Mask<T> mirror() const { return ggx_.alpha < kSmoothAlpha; }

  /// The metal's share of one spectrum and the dielectric's of the other.
  Spectrum mix(const Spectrum& metal, const Spectrum& dielectric) const {
    return metal * metallic_ + dielectric * (1.0f - metallic_);
  }

  Spectrum fresnel(T cos_theta) const {
    const T w = schlick_weight(cos_theta);
    return mix(metal_.f0 * (1.0f - w) + metal_.f90 * w, dielectric_.f0 * (1.0f - w) + dielectric_.f90 * w);
  }

  Factors of_rough(const Factors& rough, T smooth_bias) const {
    return {select(mirror(), T{}, rough.missing), select(mirror(), smooth_bias, rough.bias)};
  }
  Factors directional(T cos_theta) const {
    return of_rough(GgxAlbedo::directional(cos_theta, roughness_), schlick_weight(cos_theta));
  }
  Factors average() const { return of_rough(GgxAlbedo::average(roughness_), T{} + 1.0f / 21.0f); }

  /// Share of light that the dielectric layer lets through from a direction with these factors.
  Spectrum transmitted(const Factors& e) const {
    return Spectrum(1.0f) - dielectric_.albedo(e) - dielectric_further_ * e.missing;
  }

  /// What depends on wo alone.
  void look() {
    const Factors e = directional(wo_.z), mean = average();
    dielectric_further_ = dielectric_.further_bounces(mean);
    const Spectrum further = mix(metal_.further_bounces(mean), dielectric_further_), from_wo = transmitted(e);
    base_gain_ = diffuse_ * share(from_wo, transmitted(mean));
    further_gain_ = further * select(mean.missing > 0.0f, e.missing / mean.missing, T{});

    const T specular = mix(metal_.albedo(e), dielectric_.albedo(e)).sum();
    const T diffuse = (diffuse_ * from_wo).sum(), further_sum = further.sum() * e.missing;
    const T sum = specular + diffuse + further_sum;
    specular_probability_ = select(sum > 0.0f, specular / sum, T{} + 1.0f);
    // A little of further bounces the cosine lobe serves as well.
    const auto grazes = further_sum > 0.01f * diffuse;
    for_each_lane(grazes, [&](int i) { set_lane(grazing_, i, GrazingLobe(lane(ggx_.alpha, i))); });
    grazing_probability_ = select(grazes, further_sum / sum, T{});
    diffuse_probability_ = max(1.0f - specular_probability_ - grazing_probability_, T{});
  }

  /// The diffuse base and the further bounces, both smooth; times cos θi.
  Spectrum base(const Vec3<T>& wi) const {
    const Factors e = directional(wi.z);
    return (base_gain_ * transmitted(e) + further_gain_ * e.missing) * cosine_hemisphere_pdf(wi.z);
  }

  Vec3<T> wo_;
  T roughness_;
  BasicGgx<T> ggx_;
  T metallic_;
  Fresnel dielectric_, metal_;
  Spectrum diffuse_;

  Spectrum dielectric_further_;  ///< colour of bounces further than the first
  Spectrum base_gain_;           ///< the diffuse base as seen from wo, but for the way in from wi
  Spectrum further_gain_;        ///< all further bounces, but for the factor that depends on wi
  BasicGrazingLobe<T> grazing_;  ///< of further bounces
  T specular_probability_;       ///< of choosing the GGX lobe,
  T diffuse_probability_;        ///< the cosine,
  T grazing_probability_;        ///< and, where further bounces matter, theirs
};
template <int N>
using OpaqueBsdf = BasicOpaqueBsdf<N, float>;

}  // namespace photopic
