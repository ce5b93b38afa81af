#pragma once

#include <array>

#include "spectral/color.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

/// The N wavelengths of a path with all that depends on them alone, computed where digits are at hand for a
/// line of 0.01 nm.
template <int N>
struct PathWavelengths {
  SampledSpectrum<N> lambda;                           ///< [nm]
  SampledSpectrum<N> weight;                           ///< 1/S(λ_j) [nm]
  std::array<SampledSpectrum<N>, 3> xyz_per_radiance;  ///< h(λ_j) / (S(λ_j)·∫ȳ dλ) for X, Y and Z

  /// How much radiance counts at each wavelength, X, Y and Z alike.
  SampledSpectrum<N> importance() const {
    return xyz_per_radiance[0] + xyz_per_radiance[1] + xyz_per_radiance[2];
  }

  /// The balance-heuristic estimate of XYZ: Σ_j h(λ_j)·L(λ_j) / S(λ_j).
  Xyz to_xyz(SampledSpectrum<N> radiance) const {
    return {(xyz_per_radiance[0] * radiance).sum(), (xyz_per_radiance[1] * radiance).sum(),
            (xyz_per_radiance[2] * radiance).sum()};
  }
};

}  // namespace photopic
