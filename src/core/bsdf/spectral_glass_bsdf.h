#pragma once

#include "core/bsdf/bsdf.h"
#include "core/bsdf/further_glass.h"
#include "core/bsdf/glass_reflectance.h"
#include "core/bsdf/microfacet.h"

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
        reflectance_(m, side_ < 0.0f, !is_delta()) {
    const float total = throughput.sum();
    for (int j = 0; j < N; ++j) q_.v[j] = total == 0.0f ? 1.0f / N : throughput[j] / total;
    disperses_ = solid_ && (m.surface().disperses() || m.outside_disperses());
    if (is_delta() || wo_.z == 0.0f) return;
    g1_ = ggx_.g1(wo_);
    for (int j = 0; j < N; ++j) {
      further_[static_cast<std::size_t>(j)] = further(m, j);
      p_further_ += q_[j] * further_[static_cast<std::size_t>(j)].missing;
    }
  }

  /// Whether light comes from single directions alone, so that evaluate() has nothing.
  bool is_delta() const { return ggx_.alpha < kSmoothAlpha; }

  BsdfValue<N> evaluate(Vec3f wi) const {
    wi.z *= side_;
    if (is_delta() || wo_.z == 0.0f || wi.z == 0.0f) return {};
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
    if (!is_delta()) {
      const BsdfValue<N> value = evaluate(s->wi);
      if (value.pdf == 0.0f) return {};
      s->delta = s->split = false;
      s->pdf = value.pdf, s->weight = value.f_cos / value.pdf;
    }
    return s;
  }

 private:
  float eta(int j) const { return reflectance_.eta(j); }

  /// One bounce or passage. @param u_lobe uniform
  std::optional<BsdfSample<N>> sample_one(float u_lobe, Sample2d u) const {
    const Vec3f m = is_delta() ? Vec3f{0, 0, 1} : ggx_.sample_visible(wo_, u);
    const SampledSpectrum<N> f = reflectance_(dot(wo_, m));
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
    if (solid_ && wi.z < 0.0f) s.eta = eta(k);
    return s;
  }

  FurtherGlass further(const ShadingMaterial<N>& m, int j) const {
    if (!solid_)
      return FurtherGlass::of_thin_wall(wo_.z, m.roughness(),
                                        reflectance_.of_wall(FurtherGlass::kMeanCosine, j));
    const auto& albedo = m.surface().glass_albedo;  // none where nothing was foreseen to be refracted
    if (!albedo) return {};
    return FurtherGlass::of_solid(*albedo, wo_.z, m.roughness(), eta(j), reflectance_.beyond_bare(j));
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

  std::optional<BsdfSample<N>> bounce(Vec3f m, SampledSpectrum<N> weight) const {
    const Vec3f wi = reflect(wo_, m);
    if (wi.z <= 0.0f) return {};
    return BsdfSample<N>{wi, weight, 0.0f, true};
  }

  std::optional<BsdfSample<N>> pass(Vec3f m, SampledSpectrum<N> weight) const {
    auto s = bounce(m, weight);
    if (s) s->wi.z = -s->wi.z, s->straight = is_delta();
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
    const Vec3f wi = refract(wo_, m, eta(k));
    if (wi.z >= 0.0f) return {};
    BsdfSample<N> s{wi, SampledSpectrum<N>(0.0f), 0.0f, true};
    s.eta = eta(k);
    if (disperses_) {
      s.weight.v[k] = tint_[k] / (sqr(eta(k)) * q_[k]);
      s.split = q_[k] < 1.0f;
    } else {
      s.weight = tint_ * (SampledSpectrum<N>(1.0f) - f) / (sqr(eta(k)) * (1.0f - (q_ * f).sum()));
    }
    return s;
  }

  /// Reflection, or what passes a thin wall: the same lobe on the other side.
  BsdfValue<N> evaluate_mirrored(Vec3f wi, bool reflected) const {
    const Vec3f m = normalize(wo_ + wi);
    const SampledSpectrum<N> f = reflectance_(dot(wo_, m));
    const SampledSpectrum<N> share = reflected ? f : SampledSpectrum<N>(1.0f) - f;
    const float d = ggx_.d(m) / (4.0f * wo_.z);
    return {(reflected ? share : share * tint_) * (d * ggx_.g2(wo_, wi)), (q_ * share).sum() * d * g1_};
  }

  BsdfValue<N> evaluate_refraction(Vec3f wi) const {
    BsdfValue<N> value;
    const float g2 = ggx_.g2(wo_, wi);
    for (int j = 0; j < N; ++j) {
      Vec3f m = normalize(wo_ + wi * eta(j));
      if (m.z < 0.0f) m = -m;
      const float cos_o = dot(wo_, m);
      if (cos_o <= 0.0f || dot(wi, m) >= 0.0f) continue;
      const float common = (1.0f - reflectance_.of_interface(cos_o, j)) * ggx_.d(m) * cos_o / wo_.z *
                           refraction_jacobian(wo_, wi, m, eta(j));
      value.f_cos.v[j] = tint_[j] * common * g2 / sqr(eta(j));
      value.pdf += q_[j] * common * g1_;
    }
    return value;
  }

  float side_;  ///< −1 where wo is below; all else is mirrored to have it above
  Vec3f wo_;
  Ggx ggx_;
  bool solid_, disperses_;
  SampledSpectrum<N> tint_;
  GlassReflectance<N> reflectance_;
  SampledSpectrum<N> q_;  ///< a wavelength's probability to be chosen
  std::array<FurtherGlass, N> further_;
  float p_further_ = 0.0f;  ///< of choosing further bounces
  float g1_ = 1.0f;         ///< of wo
};

}  // namespace photopic
