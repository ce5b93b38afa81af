#pragma once

#include "optimize/objective.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// How good a sampler is under one light, in what a person can picture. No noise but that of wavelengths.
struct SamplerReport {
  double one_path_delta_e = 0;      ///< mean ΔE00 of a single path, R = 1: a quadrature over u
  double white_delta_e = 0;         ///< mean ΔE00 of the mean of 64 independent paths, R = 1
  double reflectances_delta_e = 0;  ///< the same, over test_reflectances
  double luminance_deviation = 0;   ///< standard deviation of one path's Y, R = 1, where the mean is 1
};

/// Deterministic: the paths' u have a fixed seed, the same for every sampler. 512 means of 64 paths each: a
/// standard error of some 2 % in the two means over 64 paths.
/// @param light seen by the 2° observer, scaled to Y = 1 for R = 1  @param white of CIELAB
/// @throws std::invalid_argument when the light has no luminance
SamplerReport sampler_report(const WavelengthSampler& sampler, const TabulatedSpectrum& light, White white);

}  // namespace photopic
