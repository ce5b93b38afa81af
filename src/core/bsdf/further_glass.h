#pragma once

#include "core/bsdf/ggx_albedo.h"
#include "core/bsdf/glass_albedo.h"
#include "core/bsdf/grazing_lobe.h"

namespace photopic {

/// Further bounces between the microfacets of rough glass, at one wavelength: what is missing of light from
/// wo, times what is missing of light to wi, on both sides (Kulla & Conty 2017, their equation 3 extended to
/// two hemispheres, each of which weighs with its squared index). Energy is kept exactly, and f(a, b)·η_b² =
/// f(b, a)·η_a². Directions stand as wo does, above.
struct FurtherGlass {
  static constexpr float kMeanCosine = 2.0f / 3.0f;  ///< whose reflectance stands for the mean of all

  float missing = 0.0f;  ///< of wo; the chance to be chosen for sampling

  /// @param eta n_t/n_i as seen from wo @param albedo must outlive this
  static FurtherGlass of_solid(const GlassAlbedo& albedo, float cos_theta, float roughness, float eta,
                               const GlassAlbedo::Reflection& reflection) {
    FurtherGlass g;
    g.albedo_ = &albedo, g.reflection_ = reflection, g.roughness_ = roughness, g.eta_ = eta;
    g.missing = albedo.missing(cos_theta, roughness, eta, reflection);
    const float above = albedo.average_missing(roughness, eta, reflection),
                below = sqr(eta) * albedo.average_missing(roughness, 1.0f / eta, reflection);
    g.total_ = above + below, g.above_ = above / g.total_;
    g.grazing_ = GrazingLobe(std::max(sqr(roughness), kSmoothAlpha));
    return g;
  }

  /// What passes does so as what is reflected. @param reflected share of it, whatever the directions
  static FurtherGlass of_thin_wall(float cos_theta, float roughness, float reflected) {
    FurtherGlass g;
    g.roughness_ = roughness, g.above_ = reflected;
    g.missing = GgxAlbedo::directional(cos_theta, roughness).missing;
    g.total_ = std::max(GgxAlbedo::average(roughness).missing, 1e-9f);
    g.grazing_ = GrazingLobe(std::max(sqr(roughness), kSmoothAlpha));
    return g;
  }

  /// Of radiance [1/sr].
  float f_cos(float cos_i) const {
    if (missing == 0.0f) return 0.0f;
    const float mu = std::abs(cos_i), common = missing * mu * kInvPi / total_;
    if (albedo_)
      return common * albedo_->missing(mu, roughness_, cos_i > 0.0f ? eta_ : 1.0f / eta_, reflection_);
    return common * GgxAlbedo::directional(mu, roughness_).missing * side(cos_i);
  }

  /// Of sample() [1/sr].
  float pdf(float cos_i) const { return side(cos_i) * grazing_.pdf(std::abs(cos_i)); }
  Vec3f sample(float u_side, Sample2d u) const {
    Vec3f wi = grazing_.sample(u);
    if (u_side >= above_) wi.z = -wi.z;
    return wi;
  }

 private:
  float side(float cos_i) const { return cos_i > 0.0f ? above_ : 1.0f - above_; }

  const GlassAlbedo* albedo_ = nullptr;  ///< null: a thin wall
  GlassAlbedo::Reflection reflection_;
  float roughness_ = 0.0f, eta_ = 1.0f;
  float total_ = 1.0f;  ///< missing on average, of both sides
  float above_ = 1.0f;  ///< share of what goes back to wo's side
  GrazingLobe grazing_;
};

}  // namespace photopic
