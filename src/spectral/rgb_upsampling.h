#pragma once

#include <algorithm>
#include <cmath>

#include "spectral/color.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

/// A smooth reflectance S(c0·x² + c1·x + c2), S(y) = 1/2 + y / (2·sqrt(1 + y²)), x = (λ − 360)/470:
/// Jakob & Hanika 2019, equations 3–4. Never outside [0, 1].
struct SigmoidPolynomial {
  float c0 = 0, c1 = 0, c2 = 0;

  static constexpr float kWhite = 1e5f;  ///< S(kWhite) rounds to 1 and S(−kWhite) to 0, in single precision

  template <typename T>
  T operator()(T lambda) const {
    const T x = (lambda - T(kLambdaMin)) * T(1.0 / (kLambdaMax - kLambdaMin));
    const T y = (T(c0) * x + T(c1)) * x + T(c2);
    const T within = y > T(kSaturated) ? T(kSaturated) : y < T(-kSaturated) ? T(-kSaturated) : y;
    return T(0.5) + T(0.5) * within / std::sqrt(T(1) + within * within);
  }

  template <int N>
  SampledSpectrum<N> operator()(SampledSpectrum<N> lambda) const {
    return at(lambda.v, c0, c1, c2);
  }

  /// The same with vectors of floats. @param c of the same type, or floats
  template <typename Vector, typename C>
  static Vector at(const Vector& lambda, const C& c0, const C& c1, const C& c2) {
    const Vector x =
        (lambda - static_cast<float>(kLambdaMin)) * static_cast<float>(1.0 / (kLambdaMax - kLambdaMin));
    const Vector y = (c0 * x + c1) * x + c2, most = Vector{} + kSaturated;
    const Vector below = y > most ? most : y;
    const Vector within = below < -most ? -most : below;
    return 0.5f + 0.5f * within / sqrt_of(1.0f + within * within);
  }

 private:
  static constexpr float kSaturated = 1e9f;  ///< S is 0 or 1 there, and y² is finite
};

/// The sigmoid polynomial whose colour under D65 (CIE 1931) is the given linear sRGB reflectance, by
/// Gauss–Newton on the residual; round trip within 1e-3 a channel over the cube. Components are clamped to
/// [0, 1] first, NaN to 0; greys come out constant, exactly 0 and 1 in single precision for black and white.
SigmoidPolynomial upsample_reflectance(const Rgb& linear_srgb);

/// The sigmoid that has this value in [0, 1] at all wavelengths, 0 and 1 exactly in single precision.
template <typename T>
SigmoidPolynomial constant_sigmoid(T value) {
  constexpr T kWhite = SigmoidPolynomial::kWhite;
  const T y = (value - T(0.5)) / std::sqrt(value * (T(1) - value));
  return {0.0f, 0.0f, static_cast<float>(std::clamp(y, -kWhite, kWhite))};
}

}  // namespace photopic
