#pragma once

#include "core/bsdf/ggx_albedo.h"
#include "core/bsdf/glossy_base.h"
#include "core/bsdf/sheen.h"
#include "spectral/refractive_index.h"

namespace photopic {

/// KHR_materials_clearcoat over KHR_materials_sheen over a GlossyBase. Each layer receives what those above
/// it do not reflect towards wo, by their directional albedo: no energy is gained or lost. As in glTF's own
/// layering the share T depends on wo alone, so coats are not reciprocal. Symmetric shares are, but miss the
/// 0.5 % by far where the base is a white metal under a smooth coat: T(wo)·T(wi) over its mean is 13 % of all
/// light off at roughness 0.3 and 3 % at 1, √(T(wo)·T(wi)) 16 and 21 %; what is exact depends on the base's
/// own lobe. A coat with a normal of its own loses what it sends below the base's horizon.
template <int N>
class LayeredBsdf {
 public:
  static constexpr bool kTwoSided = true;
  static constexpr bool kLitFromBehind = true;
  static constexpr bool kHasGrain = true;  ///< the frame's s and t matter
  static constexpr bool kHasCoat = true;   ///< which may have a normal of its own

  /// @param coat_normal unit, in the shading frame; where it turns away from wo the frame's own is taken
  LayeredBsdf(const ShadingMaterial<N>& m, Vec3f wo, Vec3f coat_normal = {0, 0, 1})
      : wo_(wo), base_(m, wo), sheen_(m.sheen_roughness(), {0, 0, 0}) {
    if (wo.z <= 0.0f) return;
    if (dot(coat_normal, wo) > 0.0f) coat_frame_ = Frame::about(coat_normal);
    coat_wo_ = coat_frame_.to_local(wo);
    const MaterialExtensions& x = *m.surface().extensions;
    const float coat_roughness = m.clearcoat_roughness();
    coat_ = m.clearcoat(), coat_ggx_ = {sqr(coat_roughness)};
    coat_f0_ = normal_reflectance(kCoatIndex / m.outside_index(static_cast<float>(kLineD)));
    const float coat_albedo = coat_ > 0.0f ? coat_ * schlick(coat_factors(coat_roughness)) : 0.0f;
    under_coat_ = 1.0f - coat_albedo;
    under_sheen_ = SampledSpectrum<N>(under_coat_);
    float sheen_albedo = 0.0f;
    if (x.has_sheen()) {
      sheen_ = Sheen(m.sheen_roughness(), wo);
      sheen_color_ = m.sheen_color();
      under_sheen_ = (SampledSpectrum<N>(1.0f) - sheen_color_ * sheen_.albedo()) * under_coat_;
      sheen_albedo = sheen_color_.sum() / N * sheen_.albedo() * under_coat_;
    }
    const float base_albedo = (base_.albedo() * under_sheen_).sum() / N;
    const float sum = coat_albedo + sheen_albedo + base_albedo;
    if (sum > 0.0f) p_coat_ = coat_albedo / sum, p_sheen_ = sheen_albedo / sum;
    p_base_ = std::max(1.0f - p_coat_ - p_sheen_, 0.0f);
  }

  BsdfValue<N> evaluate(Vec3f wi) const {
    if (wo_.z <= 0.0f) return {};
    BsdfValue<N> value = base_.evaluate(wi);
    value.f_cos *= under_sheen_;
    value.pdf *= p_base_;
    if (wi.z <= 0.0f) return value;
    if (p_sheen_ > 0.0f) {
      value.f_cos += sheen_color_ * (under_coat_ * sheen_.evaluate(wi));
      value.pdf += p_sheen_ * sheen_.pdf(wi);
    }
    if (const Vec3f coat_wi = coat_frame_.to_local(wi);
        p_coat_ > 0.0f && !coat_is_smooth() && coat_wi.z > 0.0f) {
      const Vec3f m = normalize(coat_wo_ + coat_wi);
      const float d = coat_ggx_.d(m) / (4.0f * coat_wo_.z);
      value.f_cos += SampledSpectrum<N>(coat_fresnel(dot(coat_wo_, m)) * d * coat_ggx_.g2(coat_wo_, coat_wi));
      value.pdf += p_coat_ * d * coat_ggx_.g1(coat_wo_);
    }
    return value;
  }

  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const {
    if (wo_.z <= 0.0f) return {};
    Vec3f wi;
    if (u_lobe < p_coat_) {
      if (coat_is_smooth()) {
        wi = coat_frame_.to_world({-coat_wo_.x, -coat_wo_.y, coat_wo_.z});
        if (wi.z <= 0.0f) return {};
        return BsdfSample<N>{wi, SampledSpectrum<N>(coat_fresnel(coat_wo_.z) / p_coat_), 0.0f, true};
      }
      const Vec3f coat_wi = reflect(coat_wo_, coat_ggx_.sample_visible(coat_wo_, u));
      wi = coat_frame_.to_world(coat_wi);
      if (coat_wi.z <= 0.0f || wi.z <= 0.0f) return {};
    } else if (u_lobe < p_coat_ + p_sheen_) {
      wi = sheen_.sample(u);
      if (wi.z == 0.0f) return {};
    } else {
      const float u_base = std::min((u_lobe - p_coat_ - p_sheen_) / p_base_, 0x1.fffffep-1f);
      auto s = base_.sample(u_base, u);
      if (!s) return {};
      if (s->delta) {
        s->weight *= under_sheen_ / p_base_;
        return s;
      }
      wi = s->wi;
    }
    const BsdfValue<N> value = evaluate(wi);
    if (value.pdf == 0.0f) return {};
    return BsdfSample<N>{wi, value.f_cos / value.pdf, value.pdf, false};
  }

 private:
  static constexpr float kCoatIndex = 1.5f;  ///< KHR_materials_clearcoat's
  float schlick(GgxAlbedo::Factors e) const { return coat_f0_ * e.scale() + e.bias; }

  bool coat_is_smooth() const { return coat_ggx_.alpha < kSmoothAlpha; }
  GgxAlbedo::Factors coat_factors(float roughness) const {
    if (!coat_is_smooth()) return GgxAlbedo::directional(coat_wo_.z, roughness);
    const float w = schlick_weight(coat_wo_.z);
    return {0.0f, w};
  }
  float coat_fresnel(float cos_theta) const {
    const float w = schlick_weight(cos_theta);
    return coat_ * schlick({0.0f, w});
  }

  Vec3f wo_;
  GlossyBase<N> base_;
  Frame coat_frame_{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< in the shading frame
  Vec3f coat_wo_;
  float coat_ = 0.0f, coat_f0_ = 0.0f;
  Ggx coat_ggx_{0.0f};
  Sheen sheen_;
  SampledSpectrum<N> sheen_color_{0.0f};
  float under_coat_ = 1.0f;               ///< share of light that the coat lets through to and from wo
  SampledSpectrum<N> under_sheen_{1.0f};  ///< the same for coat and sheen together
  float p_coat_ = 0.0f, p_sheen_ = 0.0f, p_base_ = 1.0f;  ///< of choosing each layer's lobes
};

}  // namespace photopic
