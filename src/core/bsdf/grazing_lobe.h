#pragma once

#include "core/sampling.h"

namespace photopic {

/// Where further bounces off a rough surface go (Kulla & Conty 2017): f·cos θ ∝ μ·(1 − E(μ)), the steeper to
/// the horizon the smoother the surface. Its density over the hemisphere is μ/(π L (μ² + a²)), a = 2α/(1 −
/// α): within a factor of 1.5 of it for GGX at every α, and a cosine for large α.
template <typename T>
class BasicGrazingLobe {
 public:
  BasicGrazingLobe() = default;
  /// @param alpha of GGX, at least kSmoothAlpha
  explicit BasicGrazingLobe(float alpha) requires std::is_same_v<T, float>
      : a2_(sqr(2.0f * alpha / (1.0f - std::min(alpha, 0.9f)))), log_(std::log1p(1.0f / a2_)) {}

  /// [1/sr]
  T pdf(T cos_theta) const { return kInvPi * cos_theta / (log_ * (sqr(cos_theta) + a2_)); }

  Vec3f sample(Sample2d u) const requires std::is_same_v<T, float> {
    const float z2 = std::min(a2_ * std::expm1(u.x * log_), 1.0f), r = std::sqrt(1.0f - z2);
    const SinCos phi = sin_cos_two_pi(u.y);
    return {r * phi.cos, r * phi.sin, std::sqrt(z2)};
  }

  friend BasicGrazingLobe<float> lane(const BasicGrazingLobe& lobes, int i) {
    BasicGrazingLobe<float> one;
    one.a2_ = photopic::lane(lobes.a2_, i), one.log_ = photopic::lane(lobes.log_, i);
    return one;
  }
  friend void set_lane(BasicGrazingLobe& lobes, int i, const BasicGrazingLobe<float>& one) {
    photopic::set_lane(lobes.a2_, i, one.a2_), photopic::set_lane(lobes.log_, i, one.log_);
  }

 private:
  template <typename>
  friend class BasicGrazingLobe;

  T a2_ = T{} + 1.0f;
  T log_ = T{} + 1.0f;
};
using GrazingLobe = BasicGrazingLobe<float>;

}  // namespace photopic
