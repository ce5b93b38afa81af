#pragma once

#include "core/bsdf.h"
#include "core/fresnel.h"
#include "core/further_glass.h"
#include "core/microfacet.h"
#include "spectral/refractive_index.h"

namespace photopic {

/// GlassBsdf where the index or the reflectance depends on the wavelength: dispersive glass, thin films on
/// glass, coloured reflections.
///
/// A reflection serves all wavelengths: it is chosen with their mean reflectance. So does what passes a thin
/// wall. Refraction through smooth dispersive glass serves one, chosen with probabilities q_j that follow
/// what the path carries; its weight is divided by q_j and the path is split. Refraction through rough glass
/// is sampled for one wavelength and weighed for all by the balance heuristic over them (Wilkie et al. 2014),
/// the density of a direction being Σ q_j p_j. Unbiased whatever the q_j and the densities of the wavelengths
/// are.
template <int N>
class SpectralGlassBsdf {
 public:
  static constexpr bool kTwoSided = false;
  static constexpr bool kLitFromBehind = true;

  /// @param throughput of the path: wavelengths that carry nothing are not chosen, unless none does
  SpectralGlassBsdf(const ShadingMaterial<N>& m, Vec3f wo, SampledSpectrum<N> throughput)
      : side_(wo.z < 0.0f ? -1.0f : 1.0f),
        wo_{wo.x, wo.y, wo.z * side_},
        ggx_{sqr(m.roughness())},
        solid_(m.surface().solid),
        tint_(m.base_color()),
        specular_(m.specular()),
        specular_color_(m.specular_color()) {
    float thickness = 0.0f;
    if (const MaterialExtensions* x = m.surface().extensions.get(); x && x->iridescence > 0.0f) {
      film_ = m.iridescence(), film_ior_ = x->iridescence_ior;
      thickness = m.film_thickness();
    }
    const float total = throughput.sum();
    for (int j = 0; j < N; ++j) {
      q_.v[j] = total == 0.0f ? 1.0f / N : throughput[j] / total;
      ior_.v[j] = m.surface().index(m.lambda()[j]);
      if (solid_) outside_.v[j] = m.outside_index(m.lambda()[j]);
      if (!smooth() && is_index_matched(ior_[j] / outside_[j])) ior_.v[j] = outside_[j] * kLeastRoughIor;
      eta_.v[j] = !solid_ || side_ > 0.0f ? ior_[j] / outside_[j] : outside_[j] / ior_[j];
      phase_.v[j] = 2.0f * kPi * thickness / m.lambda()[j];
    }
    disperses_ = solid_ && (m.surface().disperses() || m.outside_disperses());
    if (smooth() || wo_.z == 0.0f) return;
    g1_ = ggx_.g1(wo_);
    for (int j = 0; j < N; ++j) {
      further_[static_cast<std::size_t>(j)] = further(m, j);
      p_further_ += q_[j] * further_[static_cast<std::size_t>(j)].missing;
    }
  }

  BsdfValue<N> evaluate(Vec3f wi) const {
    wi.z *= side_;
    if (smooth() || wo_.z == 0.0f || wi.z == 0.0f) return {};
    if (wi.z > 0.0f) return with_further(evaluate_mirrored(wi, true), wi);
    if (solid_) return with_further(evaluate_refraction(wi), wi);
    return with_further(evaluate_mirrored({wi.x, wi.y, -wi.z}, false), wi);
  }

  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const {
    if (wo_.z == 0.0f) return {};
    auto s = u_lobe < p_further_
                 ? sample_further(u_lobe, u)
                 : sample_one(std::min((u_lobe - p_further_) / (1.0f - p_further_), 0x1.fffffep-1f), u);
    if (!s) return {};
    s->wi.z *= side_;
    if (!smooth()) {
      const BsdfValue<N> value = evaluate(s->wi);
      if (value.pdf == 0.0f) return {};
      s->delta = s->split = false;
      s->pdf = value.pdf, s->weight = value.f_cos / value.pdf;
    }
    return s;
  }

 private:
  bool smooth() const { return ggx_.alpha < kSmoothAlpha; }

  SampledSpectrum<N> reflectance(float cos_i) const {
    SampledSpectrum<N> f;
    for (int j = 0; j < N; ++j) {
      f.v[j] = reflectance(cos_i, j);
      if (!solid_) f.v[j] = 2.0f * f[j] / (1.0f + f[j]);
    }
    return f;
  }
  float reflectance(float cos_i, int j) const {
    float f = fresnel_dielectric(cos_i, eta_[j]);
    if (f == 1.0f) return f;
    if (film_ > 0.0f) f += film_ * (filmed(cos_i, j) - f);
    return specular_of(j).scaled(f, cos_i, eta_[j]);
  }
  SpecularScale specular_of(int j) const {
    return {specular_ * std::min(specular_color_[j], 1.0f), specular_};
  }
  float filmed(float cos_i, int j) const {
    const bool inside = solid_ && side_ < 0.0f;
    const float from = inside ? ior_[j] : outside_[j], to = inside ? outside_[j] : ior_[j];
    return ThinFilm{from, film_ior_, {to}, phase_[j]}.reflectance(cos_i);
  }

  /// One bounce or passage. @param u_lobe uniform
  std::optional<BsdfSample<N>> sample_one(float u_lobe, Sample2d u) const {
    const Vec3f m = smooth() ? Vec3f{0, 0, 1} : ggx_.sample_visible(wo_, u);
    const SampledSpectrum<N> f = reflectance(dot(wo_, m));
    const float reflected = (q_ * f).sum();
    if (u_lobe < reflected) return bounce(m, f / reflected);
    if (!solid_) return pass(m, tint_ * (SampledSpectrum<N>(1.0f) - f) / (1.0f - reflected));
    return cross(m, f, u_lobe - reflected);
  }

  /// The direction of further bounces, drawn for one wavelength. @param u uniform in [0, p_further_)
  std::optional<BsdfSample<N>> sample_further(float u, Sample2d u_direction) const {
    int k = 0;
    float share = q_[0] * further_[0].missing;
    while (k < N - 1 && u >= share) {
      u -= share;
      const auto next = static_cast<std::size_t>(++k);
      share = q_[k] * further_[next].missing;
    }
    const auto chosen = static_cast<std::size_t>(k);
    const Vec3f wi = further_[chosen].sample(share > 0.0f ? std::min(u / share, 1.0f) : 0.0f, u_direction);
    if (wi.z == 0.0f) return {};
    BsdfSample<N> s{wi, SampledSpectrum<N>(0.0f), 0.0f, false};
    if (solid_ && wi.z < 0.0f) s.eta = eta_[k];
    return s;
  }

  FurtherGlass further(const ShadingMaterial<N>& m, int j) const {
    if (!solid_) return FurtherGlass::of_thin_wall(wo_.z, m.roughness(), mean_reflectance(j));
    const auto& albedo = m.surface().glass_albedo;  // none where no wavelength is refracted
    if (!albedo) return {};
    GlassAlbedo::Reflection reflection{specular_of(j), {}};
    if (film_ > 0.0f) reflection.film = film_difference(j);
    return FurtherGlass::of_solid(*albedo, wo_.z, m.roughness(), eta_[j], reflection);
  }
  float mean_reflectance(int j) const {
    const float f = reflectance(FurtherGlass::kMeanCosine, j);
    return 2.0f * f / (1.0f + f);
  }

  /// Adds further bounces to one bounce's value; densities are shared out. wi as wo_ stands.
  BsdfValue<N> with_further(BsdfValue<N> one, Vec3f wi) const {
    one.pdf *= 1.0f - p_further_;
    for (int j = 0; j < N; ++j) {
      const FurtherGlass& g = further_[static_cast<std::size_t>(j)];
      one.f_cos.v[j] += g.f_cos(wi.z) * (wi.z > 0.0f ? 1.0f : tint_[j]);
      one.pdf += q_[j] * g.missing * g.pdf(wi.z);
    }
    return one;
  }

  /// What the film adds to the reflectance, as the albedo wants it; alike from either side.
  GlassAlbedo::Film film_difference(int j) const {
    const float thin = std::min(ior_[j], outside_[j]), dense = std::max(ior_[j], outside_[j]);
    GlassAlbedo::Film film;
    for (int k = 0; k < GlassAlbedo::kFilmNodes; ++k) {
      const float c = GlassAlbedo::film_node(k), bare = fresnel_dielectric(c, dense / thin);
      const float filmed = ThinFilm{thin, film_ior_, {dense}, phase_[j]}.reflectance(c);
      film[static_cast<std::size_t>(k)] =
          specular_of(j).scaled(bare + film_ * (filmed - bare), c, dense / thin) -
          specular_of(j).scaled(bare, c, dense / thin);
    }
    return film;
  }

  std::optional<BsdfSample<N>> bounce(Vec3f m, SampledSpectrum<N> weight) const {
    const Vec3f wi = reflect(wo_, m);
    if (wi.z <= 0.0f) return {};
    return BsdfSample<N>{wi, weight, 0.0f, true};
  }

  std::optional<BsdfSample<N>> pass(Vec3f m, SampledSpectrum<N> weight) const {
    auto s = bounce(m, weight);
    if (s) s->wi.z = -s->wi.z;
    return s;
  }

  /// Refraction, at one wavelength's index. @param u uniform in [0, Σ q_j(1 − F_j))
  std::optional<BsdfSample<N>> cross(Vec3f m, SampledSpectrum<N> f, float u) const {
    int k = -1;
    for (int j = 0; j < N && (k < 0 || u >= 0.0f); ++j) {
      const float share = q_[j] * (1.0f - f[j]);
      if (share > 0.0f) k = j;
      u -= share;
    }
    if (std::isnan(u)) k = 0;  // stays to be seen in the weight
    if (k < 0) return {};
    const Vec3f wi = refract(wo_, m, eta_[k]);
    if (wi.z >= 0.0f) return {};
    BsdfSample<N> s{wi, SampledSpectrum<N>(0.0f), 0.0f, true};
    s.eta = eta_[k];
    if (disperses_) {
      s.weight.v[k] = tint_[k] / (sqr(eta_[k]) * q_[k]);
      s.split = q_[k] < 1.0f;
    } else {
      s.weight = tint_ * (SampledSpectrum<N>(1.0f) - f) / (sqr(eta_[k]) * (1.0f - (q_ * f).sum()));
    }
    return s;
  }

  /// Reflection, or what passes a thin wall: the same lobe on the other side.
  BsdfValue<N> evaluate_mirrored(Vec3f wi, bool reflected) const {
    const Vec3f m = normalize(wo_ + wi);
    const SampledSpectrum<N> f = reflectance(dot(wo_, m));
    const SampledSpectrum<N> share = reflected ? f : SampledSpectrum<N>(1.0f) - f;
    const float d = ggx_.d(m) / (4.0f * wo_.z);
    return {(reflected ? share : share * tint_) * (d * ggx_.g2(wo_, wi)), (q_ * share).sum() * d * g1_};
  }

  BsdfValue<N> evaluate_refraction(Vec3f wi) const {
    BsdfValue<N> value;
    const float g2 = ggx_.g2(wo_, wi);
    for (int j = 0; j < N; ++j) {
      Vec3f m = normalize(wo_ + wi * eta_[j]);
      if (m.z < 0.0f) m = -m;
      const float cos_o = dot(wo_, m);
      if (cos_o <= 0.0f || dot(wi, m) >= 0.0f) continue;
      const float common = (1.0f - reflectance(cos_o, j)) * ggx_.d(m) * cos_o / wo_.z *
                           refraction_jacobian(wo_, wi, m, eta_[j]);
      value.f_cos.v[j] = tint_[j] * common * g2 / sqr(eta_[j]);
      value.pdf += q_[j] * common * g1_;
    }
    return value;
  }

  float side_;  ///< −1 where wo is below; all else is mirrored to have it above
  Vec3f wo_;
  Ggx ggx_;
  bool solid_, disperses_;
  SampledSpectrum<N> tint_;
  float specular_;
  SampledSpectrum<N> specular_color_;
  float film_ = 0.0f, film_ior_ = 1.0f;
  SampledSpectrum<N> q_;  ///< a wavelength's probability to be chosen
  SampledSpectrum<N> ior_;
  SampledSpectrum<N> outside_{1.0f};  ///< index of the medium in front
  SampledSpectrum<N> eta_;            ///< η_t/η_i
  SampledSpectrum<N> phase_;          ///< of the film: 2π·thickness/λ
  std::array<FurtherGlass, N> further_;
  float p_further_ = 0.0f;  ///< of choosing further bounces
  float g1_ = 1.0f;         ///< of wo
};

}  // namespace photopic
