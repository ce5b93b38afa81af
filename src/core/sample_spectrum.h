#pragma once

#include "spectral/spectrum.h"

namespace photopic {

/// A spectrum at a path's N wavelengths [nm]: the kind of spectrum is asked for once, not N times.
template <int N>
SampledSpectrum<N> sample_spectrum(const Spectrum& spectrum, SampledSpectrum<N> lambda) {
  if (const auto* constant = std::get_if<ConstantSpectrum>(&spectrum))
    return SampledSpectrum<N>(static_cast<float>(constant->value));
  if (const auto* sigmoid = std::get_if<SigmoidPolynomial>(&spectrum)) return (*sigmoid)(lambda);
  SampledSpectrum<N> result;
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) {
    for (int j = 0; j < N; ++j) result.v[j] = static_cast<float>((*table)(lambda[j]));
  } else {
    for (int j = 0; j < N; ++j) result.v[j] = static_cast<float>(evaluate(spectrum, lambda[j]));
  }
  return result;
}

}  // namespace photopic
