#pragma once

#include <array>

#include "spectral/observer.h"
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

/// Looked up one by one.
template <int N>
PathWavelengths<N> look_up(const SampledWavelengths<N>& w, const Observer& observer) {
  PathWavelengths<N> path;
  for (int j = 0; j < N; ++j) {
    const double lambda = w.lambda[j], weight = 1.0 / w.density_sum[j];
    const Xyz h = observer(lambda) * (weight / observer.y_integral());
    path.lambda.v[j] = static_cast<float>(lambda);
    path.weight.v[j] = static_cast<float>(weight);
    path.xyz_per_radiance[0].v[j] = static_cast<float>(h.x);
    path.xyz_per_radiance[1].v[j] = static_cast<float>(h.y);
    path.xyz_per_radiance[2].v[j] = static_cast<float>(h.z);
  }
  return path;
}

}  // namespace photopic
