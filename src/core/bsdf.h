#pragma once

#include <optional>

#include "core/frame.h"
#include "core/sampling.h"
#include "core/shading_material.h"

namespace photopic {

/// BSDFs work in the shading frame, the normal being +z and wo lying in the upper hemisphere (glass: either).
/// wo points to the viewer, wi to where light comes from; both unit. A BSDF is made for one wo.

/// Value and density of the lobes that are not delta functions.
template <int N>
struct BsdfValue {
  SampledSpectrum<N> f_cos{0.0f};  ///< f(wo, wi)·|cos θi| [1/sr]
  float pdf = 0.0f;                ///< of sample() giving wi, w.r.t. solid angle [1/sr]
};

template <int N>
struct BsdfSample {
  Vec3f wi;
  SampledSpectrum<N> weight;  ///< f·|cos θi| / pdf
  float pdf;                  ///< w.r.t. solid angle [1/sr]; meaningless when delta
  bool delta;                 ///< no other technique can find wi
  float eta = 1.0f;           ///< ratio of refractive indices crossed, η_t/η_i
  bool split = false;         ///< the direction is one wavelength's: the weights of all others are zero
};

/// Lambert.
template <int N>
struct DiffuseBsdf {
  static constexpr bool kTwoSided = true;
  static constexpr bool kLitFromBehind = false;

  SampledSpectrum<N> albedo;

  DiffuseBsdf(const ShadingMaterial<N>& material, Vec3f) : albedo(material.base_color()) {}

  BsdfValue<N> evaluate(Vec3f wi) const {
    if (wi.z <= 0.0f) return {};
    const float pdf = cosine_hemisphere_pdf(wi.z);
    return {albedo * pdf, pdf};
  }

  std::optional<BsdfSample<N>> sample(float, Sample2d u) const {
    return sample_towards(sample_cosine_hemisphere(u));
  }
  /// @param wi of sample_cosine_hemisphere()
  std::optional<BsdfSample<N>> sample_towards(Vec3f wi) const {
    if (wi.z <= 0.0f) return {};
    return BsdfSample<N>{wi, albedo, cosine_hemisphere_pdf(wi.z), false};
  }
};

}  // namespace photopic
