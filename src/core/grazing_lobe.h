#pragma once

#include "core/sampling.h"

namespace photopic {

/// Where further bounces off a rough surface go (Kulla & Conty 2017): f·cos θ ∝ μ·(1 − E(μ)), the steeper to
/// the horizon the smoother the surface. Its density over the hemisphere is μ/(π L (μ² + a²)), a = 2α/(1 −
/// α): within a factor of 1.5 of it for GGX at every α, and a cosine for large α.
class GrazingLobe {
 public:
  GrazingLobe() = default;
  /// @param alpha of GGX, at least kSmoothAlpha
  explicit GrazingLobe(float alpha)
      : a2_(sqr(2.0f * alpha / (1.0f - std::min(alpha, 0.9f)))), log_(std::log1p(1.0f / a2_)) {}

  /// [1/sr]
  float pdf(float cos_theta) const { return kInvPi * cos_theta / (log_ * (sqr(cos_theta) + a2_)); }

  Vec3f sample(Sample2d u) const {
    const float z2 = std::min(a2_ * std::expm1(u.x * log_), 1.0f), r = std::sqrt(1.0f - z2);
    const SinCos phi = sin_cos_two_pi(u.y);
    return {r * phi.cos, r * phi.sin, std::sqrt(z2)};
  }

 private:
  float a2_ = 1.0f;
  float log_ = 1.0f;
};

}  // namespace photopic
