#pragma once

#include <array>

#include "spectral/float_vectors.h"

namespace photopic {

/// The range of wavelengths that is rendered, Λ [nm]; outside it the CIE 1931 observer is blind for our
/// purposes.
inline constexpr double kLambdaMin = 360.0;
inline constexpr double kLambdaMax = 830.0;

/// The processor's vector of N floats. Spelled out: compilers ignore a vector size that depends on a template
/// parameter when they compare overloads.
template <int N>
struct FloatLanes;
template <>
struct FloatLanes<1> {
  using Type = Float1;
};
template <>
struct FloatLanes<4> {
  using Type = Float4;
};
template <>
struct FloatLanes<8> {
  using Type = Float8;
};
template <>
struct FloatLanes<16> {
  using Type = Float16;
};

/// N values of one spectral quantity, at the N wavelengths of the path they travel with; N is 1, 4, 8 or 16.
template <int N>
struct SampledSpectrum {
  using Vector = typename FloatLanes<N>::Type;
  Vector v;

  SampledSpectrum() = default;
  explicit SampledSpectrum(float value) : v(Vector{} + value) {}
  SampledSpectrum(Vector vector) : v(vector) {}

  float operator[](int i) const { return v[i]; }
  void set(int i, float value) { v[i] = value; }

  friend SampledSpectrum operator+(SampledSpectrum a, SampledSpectrum b) { return {a.v + b.v}; }
  friend SampledSpectrum operator-(SampledSpectrum a, SampledSpectrum b) { return {a.v - b.v}; }
  friend SampledSpectrum operator*(SampledSpectrum a, SampledSpectrum b) { return {a.v * b.v}; }
  friend SampledSpectrum operator/(SampledSpectrum a, SampledSpectrum b) { return {a.v / b.v}; }
  friend SampledSpectrum operator*(SampledSpectrum a, float s) { return {a.v * s}; }
  friend SampledSpectrum operator*(float s, SampledSpectrum a) { return {a.v * s}; }
  friend SampledSpectrum operator/(SampledSpectrum a, float s) { return {a.v / s}; }
  SampledSpectrum& operator+=(SampledSpectrum b) { return v += b.v, *this; }
  SampledSpectrum& operator*=(SampledSpectrum b) { return v *= b.v, *this; }
  SampledSpectrum& operator*=(float s) { return v *= s, *this; }

  /// Whether nothing is left; not a number is not nothing.
  bool is_black() const {
    for (int i = 0; i < N; ++i)
      if (!(v[i] <= 0.0f)) return false;
    return true;
  }
  float sum() const { return sum_of(v); }
};

/// The wavelengths of one path, with their densities, so that no estimate can forget the divide.
template <int N>
struct SampledWavelengths {
  std::array<double, N> lambda;       ///< [nm]
  std::array<double, N> density_sum;  ///< S(λ_j) = Σ_k p_k(λ_j) [1/nm]: the balance heuristic's denominator
};

}  // namespace photopic
