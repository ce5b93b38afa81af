#pragma once

#include <optional>

#include "core/bsdf/shading_material.h"
#include "core/frame.h"
#include "core/sampling.h"
#include "core/spectrum_lanes.h"

namespace photopic {

/// BSDFs work in the shading frame, the normal being +z and wo lying in the upper hemisphere (glass: either).
/// wo points to the viewer, wi to where light comes from; both unit. A BSDF is made for one wo. Those that
/// are templates on T serve one path (float) or 16 at once (Lanes).

/// Value and density of the lobes that are not delta functions.
template <int N, typename T>
struct BasicBsdfValue {
  SpectrumOf<N, T> f_cos{0.0f};  ///< f(wo, wi)·|cos θi| [1/sr]
  T pdf{};                       ///< of sample() giving wi, w.r.t. solid angle [1/sr]
};
template <int N>
using BsdfValue = BasicBsdfValue<N, float>;

template <int N>
struct BsdfSample {
  Vec3f wi;
  SampledSpectrum<N> weight;  ///< f·|cos θi| / pdf
  float pdf;                  ///< w.r.t. solid angle [1/sr]; meaningless when delta
  bool delta;                 ///< no other technique can find wi
  float eta = 1.0f;           ///< ratio of refractive indices crossed, η_t/η_i
  bool split = false;         ///< the direction is one wavelength's: the weights of all others are zero
  bool straight = false;      ///< of a delta: the path goes on as it came, as shadow rays do
};

/// A BsdfSample that reflects, or one in each lane, where there is one.
template <int N, typename T>
struct BsdfDraw {
  Vec3<T> wi;
  SpectrumOf<N, T> weight;
  T pdf;
  Mask<T> delta, found;

  std::optional<BsdfSample<N>> sample() const requires std::is_same_v<T, float> {
    if (!found) return {};
    return BsdfSample<N>{wi, weight, pdf, delta};
  }
};

/// Lambert.
template <int N, typename T>
struct BasicDiffuseBsdf {
  static constexpr bool kTwoSided = true;
  static constexpr bool kLitFromBehind = false;

  SpectrumOf<N, T> albedo;

  BasicDiffuseBsdf(const SpectrumOf<N, T>& color, const Vec3<T>&) : albedo(color) {}
  BasicDiffuseBsdf(const ShadingMaterial<N>& material, Vec3f) : albedo(material.base_color()) {}

  BasicBsdfValue<N, T> evaluate(const Vec3<T>& wi) const {
    const T pdf = cosine_hemisphere_pdf(wi.z);
    return {albedo * pdf, pdf};
  }

  BsdfDraw<N, T> draw(T, BasicSample2d<T> u) const {
    const Vec3<T> wi = sample_cosine_hemisphere(u);
    return {wi, albedo, cosine_hemisphere_pdf(wi.z), Mask<T>{}, wi.z > 0.0f};
  }
  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const { return draw(u_lobe, u).sample(); }
};
template <int N>
using DiffuseBsdf = BasicDiffuseBsdf<N, float>;

}  // namespace photopic
