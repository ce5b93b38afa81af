#pragma once

#include <bit>
#include <type_traits>

#include "core/lane_rows.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

/// One spectral quantity of 16 paths at the N wavelengths of each: a vector across paths for each of the N.
/// Takes the operators of SampledSpectrum, Lanes standing for float.
template <int N>
struct SpectrumLanes {
  std::array<Lanes, N> v;

  SpectrumLanes() = default;
  explicit SpectrumLanes(Lanes value) { v.fill(value); }
  explicit SpectrumLanes(float value) : SpectrumLanes(Lanes{} + value) {}

  friend SpectrumLanes operator+(const SpectrumLanes& a, const SpectrumLanes& b) {
    return each([](Lanes x, Lanes y) { return x + y; }, a, b);
  }
  friend SpectrumLanes operator-(const SpectrumLanes& a, const SpectrumLanes& b) {
    return each([](Lanes x, Lanes y) { return x - y; }, a, b);
  }
  friend SpectrumLanes operator*(const SpectrumLanes& a, const SpectrumLanes& b) {
    return each([](Lanes x, Lanes y) { return x * y; }, a, b);
  }
  friend SpectrumLanes operator/(const SpectrumLanes& a, const SpectrumLanes& b) {
    return each([](Lanes x, Lanes y) { return x / y; }, a, b);
  }
  friend SpectrumLanes operator*(const SpectrumLanes& a, Lanes s) { return a * SpectrumLanes(s); }
  friend SpectrumLanes operator*(const SpectrumLanes& a, float s) { return a * (Lanes{} + s); }
  friend SpectrumLanes operator/(const SpectrumLanes& a, Lanes s) { return a * (1.0f / s); }
  SpectrumLanes& operator+=(const SpectrumLanes& b) { return *this = *this + b; }
  SpectrumLanes& operator*=(const SpectrumLanes& b) { return *this = *this * b; }

  Lanes sum() const {
    Lanes all = v[0];
    for (std::size_t j = 1; j < N; ++j) all += v[j];
    return all;
  }
  Lanes max() const {
    Lanes largest = v[0];
    for (std::size_t j = 1; j < N; ++j) largest = photopic::max(largest, v[j]);
    return largest;
  }
  /// See SampledSpectrum; a mask.
  IntLanes is_black() const {
    IntLanes black = v[0] <= 0.0f;
    for (std::size_t j = 1; j < N; ++j) black &= v[j] <= 0.0f;
    return black;
  }

  /// f of the vectors of each wavelength.
  template <typename F, typename... Spectra>
  static SpectrumLanes each(const F& f, const Spectra&... spectra) {
    SpectrumLanes result;
    for (std::size_t j = 0; j < N; ++j) result.v[j] = f(spectra.v[j]...);
    return result;
  }
};

/// The spectral quantity that goes with numbers T: of one path (float) or 16.
template <int N, typename T>
using SpectrumOf = std::conditional_t<std::is_same_v<T, float>, SampledSpectrum<N>, SpectrumLanes<N>>;

// What SampledSpectrum and SpectrumLanes are asked besides.

template <int N>
SampledSpectrum<N> select(bool condition, SampledSpectrum<N> a, SampledSpectrum<N> b) {
  return condition ? a : b;
}
template <int N>
SpectrumLanes<N> select(IntLanes condition, const SpectrumLanes<N>& a, const SpectrumLanes<N>& b) {
  return SpectrumLanes<N>::each([&](Lanes x, Lanes y) { return select(condition, x, y); }, a, b);
}

/// No more than 1.
template <int N>
SampledSpectrum<N> at_most_1(SampledSpectrum<N> a) {
  return {a.v > 1.0f ? typename SampledSpectrum<N>::Vector{} + 1.0f : a.v};
}
template <int N>
SpectrumLanes<N> at_most_1(const SpectrumLanes<N>& a) {
  return SpectrumLanes<N>::each([](Lanes x) { return min(x, Lanes{} + 1.0f); }, a);
}

/// a / b where b is positive, else 0.
template <int N>
SampledSpectrum<N> share(SampledSpectrum<N> a, SampledSpectrum<N> b) {
  return {b.v > 0.0f ? a.v / b.v : typename SampledSpectrum<N>::Vector{}};
}
template <int N>
SpectrumLanes<N> share(const SpectrumLanes<N>& a, const SpectrumLanes<N>& b) {
  return SpectrumLanes<N>::each([](Lanes x, Lanes y) { return select(y > 0.0f, x / y, Lanes{}); }, a, b);
}

/// @param at gives the address of a lane's spectrum
template <int N, typename At>
PHOTOPIC_INLINE SpectrumLanes<N> gather_spectra(const At& at) {
  SpectrumLanes<N> result;
  result.v = gather_rows<N>(at);
  return result;
}

/// A spectrum for each lane.
template <int N>
using LaneSpectra = std::array<SampledSpectrum<N>, kLanes>;

template <int N>
PHOTOPIC_INLINE SpectrumLanes<N> to_lanes(const LaneSpectra<N>& spectra) {
  return gather_spectra<N>([&](int i) { return &spectra[static_cast<std::size_t>(i)]; });
}
template <int N>
PHOTOPIC_INLINE LaneSpectra<N> by_lane(const SpectrumLanes<N>& spectra) {
  return std::bit_cast<LaneSpectra<N>>(rows_of(spectra.v));
}

template <int N>
PHOTOPIC_INLINE SpectrumLanes<N> gather(const SampledSpectrum<N>* from, const Packet& packet) {
  return gather_spectra<N>([&](int i) { return &from[packet[i]]; });
}

}  // namespace photopic
