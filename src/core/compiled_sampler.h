#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/spectrum_lanes.h"
#include "spectral/observer.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// Where the wavelengths of a path lie in the tables of a CompiledSampler.
template <int N>
struct WavelengthPlaces {
  std::array<std::uint32_t, N> cell;
  SampledSpectrum<N> fraction;  ///< of the cell
};

/// The wavelengths of 16 paths, and where they lie in the tables.
template <int N>
struct WavelengthLanes {
  SpectrumLanes<N> lambda;  ///< [nm]
  SpectrumLanes<N> weight;  ///< 1/S(λ_j) [nm]

  std::array<std::array<std::uint32_t, kLanes>, N> cell;
  SpectrumLanes<N> fraction;  ///< of the cell

  WavelengthPlaces<N> place(int path) const {
    WavelengthPlaces<N> places;
    for (std::size_t k = 0; k < N; ++k) {
      places.cell[k] = cell[k][static_cast<std::size_t>(path)];
      places.fraction.v[k] = lane(fraction.v[k], path);
    }
    return places;
  }
};

/// A wavelength sampler together with what every path looks up at its wavelengths, the observer and the
/// lamps' emissions, for renders: on the cells between all their knots each is linear, in λ or in t = B(λ),
/// so that one search gives everything. Places within a cell are single precision, which resolves lines of
/// any width, and u is a whole number. (The sech² density of VisibleWavelengths is drawn as a polygon through
/// its values at every nanometre.)
class CompiledSampler {
 public:
  /// @param emissions zero outside [360, 830] nm (tabulate_emission)
  CompiledSampler(const WavelengthSampler& sampler, const Observer& observer,
                  std::span<const TabulatedSpectrum> emissions);

  /// draw_wavelengths at u = (bits + 1/2)/2³², N = wavelength_count(sampler).
  template <int N>
  PHOTOPIC_INLINE WavelengthLanes<N> draw(UintLanes bits) const;

  /// Four of the spectra x̄, ȳ, z̄ (over ∫ȳ dλ [1/nm]), then the emissions, from the first or a fourth one on.
  template <int N>
  PHOTOPIC_INLINE std::array<SpectrumLanes<N>, 4> look_up(const WavelengthLanes<N>& w,
                                                          std::size_t first) const;

  /// One of those spectra for one path.
  template <int N>
  SampledSpectrum<N> look_up(const WavelengthPlaces<N>& w, std::size_t spectrum) const {
    const std::vector<Columns>& columns = columns_[spectrum / 4];
    SampledSpectrum<N> values;
    for (std::size_t k = 0; k < N; ++k) {
      const Columns& c = columns[w.cell[k]];
      values.v[k] = c.at_begin[spectrum % 4] + c.rise[spectrum % 4] * w.fraction.v[k];
    }
    return values;
  }

 private:
  /// Four spectra's values where a cell begins, and what is added up to its end.
  struct Columns {
    std::array<float, 4> at_begin, rise;
  };
  /// The base density is b + b_slope·(λ − lambda), Σ_k q_k is sum + sum_slope·dt.
  struct Cell {
    float lambda, width, per_width, b, b_slope, sum, sum_slope, unused = 0.0f;
  };
  /// How density k crosses a cell, with q_k = q + q_slope·dt: bits v > `before` lead v − before + rest quanta
  /// of 2⁻³² into it.
  struct Crossing {
    std::uint32_t before;
    float rest;
    float q, q_slope;
  };
  /// What drives a density: u, 1 − u, or u turned round by a fraction.
  struct Drive {
    std::uint32_t flip = 0, turn = 0;
    template <typename U>
    U operator()(U bits) const {
      return (bits ^ flip) + turn;
    }
  };
  struct Build;

  static std::uint32_t find(std::span<const Crossing> crossings, std::uint32_t v, std::uint32_t cell);

  std::vector<Cell> cells_;
  std::vector<std::vector<Columns>> columns_;     ///< of four spectra each, a cell an entry
  std::vector<std::vector<Crossing>> crossings_;  ///< of each density, a cell each and one behind the last
  std::vector<Drive> drives_;
  int step_bits_ = 0;                 ///< of u, that tell a step of the guide
  std::vector<std::uint32_t> guide_;  ///< of each step and density: its first cell there
};

/// A linear density f + slope·s, followed until it has gathered a mass: f·s + slope·s²/2 = mass.
struct Way {
  Lanes s;
  Lanes density;  ///< there; above f/4096, for what rounding leaves of less is not to be divided by
};

/// This form of the root neither cancels nor divides by a slope of zero, and the square root itself is the
/// density.
PHOTOPIC_INLINE Way way_to(Lanes mass, Lanes f, Lanes slope) {
  const Lanes square = f * f, density = sqrt(max(square + 2.0f * slope * mass, square * 0x1p-24f));
  return {2.0f * mass / (f + density + std::numeric_limits<float>::min()), density};
}

/// The guide is Chen & Asau's, see GuideTable; here one for the u that drives all N.
inline std::uint32_t CompiledSampler::find(std::span<const Crossing> crossings, std::uint32_t v,
                                           std::uint32_t cell) {
  cell += v > crossings[cell + 1].before;
  if (v > crossings[cell + 1].before) [[unlikely]] {
    const auto reached = [v](const Crossing& c) { return c.before < v; };
    const auto next = std::partition_point(crossings.begin() + cell + 1, crossings.end(), reached);
    cell = static_cast<std::uint32_t>(next - crossings.begin()) - 1;
  }
  return cell;
}

template <int N>
PHOTOPIC_INLINE WavelengthLanes<N> CompiledSampler::draw(UintLanes bits) const {
  WavelengthLanes<N> w;
  const UintLanes step = (bits >> (32 - step_bits_)) * static_cast<std::uint32_t>(N);
  for (std::size_t k = 0; k < N; ++k) {
    const std::span<const Crossing> crossings(crossings_[k]);
    const UintLanes v = drives_[k](bits);
    auto& cell = w.cell[k];
    for (int i = 0; i < kLanes; ++i)
      cell[static_cast<std::size_t>(i)] = find(crossings, lane(v, i), guide_[lane(step, i) + k]);

    const auto [before, rest, q, q_slope] =
        gather_rows<4>([&](int i) { return &crossings[cell[static_cast<std::size_t>(i)]]; });
    const auto [lambda, width, per_width, b, b_slope, sum, sum_slope, unused] =
        gather_rows<8>([&](int i) { return &cells_[cell[static_cast<std::size_t>(i)]]; });
    // By q's inverse to t, then by the base's to λ.
    const Lanes quanta = __builtin_convertvector(v - reinterpret_cast<UintLanes>(before), Lanes) + rest;
    const Way t = way_to(quanta * 0x1p-32f, q, q_slope), nm = way_to(t.s, b, b_slope);
    w.fraction.v[k] = min(Lanes{} + 1.0f, nm.s * per_width);
    w.lambda.v[k] = lambda + width * w.fraction.v[k];
    w.weight.v[k] = 1.0f / (max(sum + sum_slope * t.s, t.density) * nm.density);
  }
  return w;
}

template <int N>
PHOTOPIC_INLINE std::array<SpectrumLanes<N>, 4> CompiledSampler::look_up(const WavelengthLanes<N>& w,
                                                                         std::size_t first) const {
  const std::vector<Columns>& columns = columns_[first / 4];
  std::array<SpectrumLanes<N>, 4> values;
  for (std::size_t k = 0; k < N; ++k) {
    const auto c = gather_rows<8>([&](int i) { return &columns[w.cell[k][static_cast<std::size_t>(i)]]; });
    for (std::size_t s = 0; s < 4; ++s) values[s].v[k] = c[s] + c[s + 4] * w.fraction.v[k];
  }
  return values;
}

}  // namespace photopic
