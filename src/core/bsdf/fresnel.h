#pragma once

#include "core/math.h"

namespace photopic {

/// Reflectances of unpolarised light at plane interfaces; cos_i > 0 is against the normal on the incident
/// side. Indices are n + ik with k ≥ 0 where light is absorbed. (Born & Wolf 1999, sections 1.5, 1.6
/// and 14.2.)

/// A dielectric interface. @param eta n_t/n_i
inline float fresnel_dielectric(float cos_i, float eta) {
  const float sin2_t = (1.0f - sqr(cos_i)) / sqr(eta);
  if (sin2_t >= 1.0f) return 1.0f;
  const float cos_t = std::sqrt(1.0f - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (sqr(parallel) + sqr(perpendicular));
}

/// The same at normal incidence. @param eta 0: a perfect mirror
inline float normal_reflectance(float eta) {
  return eta == 0.0f ? 1.0f : sqr((eta - 1.0f) / (eta + 1.0f));
}

/// Schlick's (1 − cos θ)⁵.
template <typename T>
T schlick_weight(T cos_theta) {
  const T x = min(max(1.0f - cos_theta, T{}), T{} + 1.0f);
  return sqr(sqr(x)) * x;
}

/// KHR_materials_specular on a dielectric interface's reflectance. A colour below 1 dims it, by Schlick's
/// blend, which goes by the angle in the thinner medium, so that both directions of one ray have the same. A
/// colour above 1 dims what passes, which scales Schlick's F0 just so and leaves no reflectance above 1.
/// Total reflection stays what it is. @param eta n_t/n_i
struct SpecularScale {
  float at_normal = 1.0f, at_grazing = 1.0f;
  float passed = 1.0f;  ///< what passes, before these two

  /// @param color on the reflectance at normal incidence; the product ends at 1
  static SpecularScale of(float specular, float color, float eta) {
    if (color <= 1.0f) return {specular * color, specular};
    const float r0 = normal_reflectance(eta);
    return {specular, specular, (1.0f - std::min(color * r0, 1.0f)) / (1.0f - r0)};
  }

  float scaled(float reflectance, float cos_i, float eta) const {
    if (reflectance >= 1.0f) return 1.0f;
    if (passed != 1.0f) reflectance = 1.0f - passed * (1.0f - reflectance);
    if (at_normal == at_grazing) return reflectance * at_normal;
    return reflectance * (at_normal + (at_grazing - at_normal) * schlick_weight(thin_cosine(cos_i, eta)));
  }
  static float thin_cosine(float cos_i, float eta) {
    return eta >= 1.0f ? cos_i : safe_sqrt(1.0f - (1.0f - sqr(cos_i)) / sqr(eta));
  }
};

/// A metal's surface. @param n, k of the metal over those of the (transparent) medium outside
inline float fresnel_conductor(float cos_i, float n, float k) {
  const float cos2 = sqr(cos_i), sin2 = 1.0f - cos2;
  const float difference = sqr(n) - sqr(k) - sin2;
  const float modulus = std::sqrt(sqr(difference) + 4.0f * sqr(n) * sqr(k));  // a² + b²: q = a + ib below
  const float twice_a_cos = 2.0f * cos_i * safe_sqrt(0.5f * (modulus + difference));
  const float perpendicular = (modulus + cos2 - twice_a_cos) / (modulus + cos2 + twice_a_cos);
  const float sum = cos2 * modulus + sqr(sin2), product = twice_a_cos * sin2;
  return 0.5f * perpendicular * (1.0f + (sum - product) / (sum + product));
}

/// A complex number without the library's care for infinities.
struct Complex {
  float re = 0.0f, im = 0.0f;

  friend Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
  friend Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
  friend Complex operator*(Complex a, Complex b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Complex operator/(Complex a, Complex b) {
    const float scale = 1.0f / b.norm();
    return {(a.re * b.re + a.im * b.im) * scale, (a.im * b.re - a.re * b.im) * scale};
  }
  float norm() const { return sqr(re) + sqr(im); }  ///< |z|²
};

/// The root with re ≥ 0 and im ≥ 0; for z with im ≥ 0.
inline Complex complex_sqrt(Complex z) {
  const float modulus = std::sqrt(z.norm());
  return {safe_sqrt(0.5f * (modulus + z.re)), safe_sqrt(0.5f * (modulus - z.re))};
}

/// A film on a base: the sum over all bounces in the film (Airy), both polarisations, coherent. Evaluated at
/// one wavelength, where Belcour & Barla 2017 average over the eye's responses.
struct ThinFilm {
  float outside = 1.0f;      ///< index of the medium that light comes from
  float film = 1.0f;         ///< index of the film
  Complex base{1.5f, 0.0f};  ///< index of what the film lies on
  float phase = 0.0f;        ///< 2π·thickness/λ

  float reflectance(float cos_i) const {
    cos_i = std::max(cos_i, 1e-6f);  // q0 = q2 = 0 would be 0/0 where the film is half a wave
    const Complex n0{outside}, n1{film}, e0 = n0 * n0, e1 = n1 * n1, e2 = base * base;
    // n cos θ in each medium, from Snell's law: q² = n² − n0² + q0², which cancels nothing at grazing
    // incidence.
    const Complex q0{outside * cos_i}, q1 = complex_sqrt(off_zero((n1 - n0) * (n1 + n0) + q0 * q0)),
                                       q2 = complex_sqrt((base - n0) * (base + n0) + q0 * q0);
    // e^{2iβ}, β = q1·phase.
    const float damping = std::exp(-2.0f * phase * q1.im), angle = 2.0f * phase * q1.re;
    const Complex round{damping * std::cos(angle), damping * std::sin(angle)};
    const float perpendicular = airy((q0 - q1) / (q0 + q1), (q1 - q2) / (q1 + q2), round);
    const float parallel =
        airy((e1 * q0 - e0 * q1) / (e1 * q0 + e0 * q1), (e2 * q1 - e1 * q2) / (e2 * q1 + e1 * q2), round);
    return std::min(0.5f * (perpendicular + parallel), 1.0f);
  }

 private:
  /// At the critical angle of a film that is thinner than what is outside, the sum is 0/0. It is even in q1,
  /// so that its limit is as good a little beside.
  static Complex off_zero(Complex q1_squared) {
    constexpr float kLeast = 1e-6f;
    if (std::abs(q1_squared.re) < kLeast) q1_squared.re = std::copysign(kLeast, q1_squared.re);
    return q1_squared;
  }
  static float airy(Complex first, Complex second, Complex round) {
    const Complex returning = second * round;
    return ((first + returning) / (Complex{1.0f} + first * returning)).norm();
  }
};

}  // namespace photopic
