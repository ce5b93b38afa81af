#pragma once

#include <array>

#include "spectral/rgb_upsampling.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

/// Spectra that tint a white lamp: red, green, blue, cyan, magenta, yellow of linear sRGB under D65, as
/// upsample_reflectance() makes them.
const std::array<SigmoidPolynomial, 6>& rgb_tints();

/// The tints at a path's N wavelengths: any linear sRGB light, however bright, as a factor on the lamp. It is
/// linear between the colours of least and greatest saturation (Smits 1999, "An RGB to Spectrum Conversion
/// for Reflectances"), so that pixels are interpolated and scaled before they become spectra; grey is
/// constant.
template <int N>
struct SampledTints {
  std::array<SampledSpectrum<N>, 6> tint;

  SampledTints() = default;
  explicit SampledTints(SampledSpectrum<N> lambda) {
    const auto& tints = rgb_tints();
    for (std::size_t i = 0; i < tint.size(); ++i) tint[i] = tints[i](lambda);
  }

  /// @param r, g, b not negative
  SampledSpectrum<N> operator()(float r, float g, float b) const {
    enum { red, green, blue, cyan, magenta, yellow };
    if (r <= g && r <= b) return mix(r, std::min(g, b), cyan, std::max(g, b), g >= b ? green : blue);
    if (g <= b) return mix(g, std::min(r, b), magenta, std::max(r, b), r >= b ? red : blue);
    return mix(b, std::min(r, g), yellow, std::max(r, g), r >= g ? red : green);
  }

 private:
  SampledSpectrum<N> mix(float low, float middle, int secondary, float high, int primary) const {
    return SampledSpectrum<N>(low) + tint[static_cast<std::size_t>(secondary)] * (middle - low) +
           tint[static_cast<std::size_t>(primary)] * (high - middle);
  }
};

}  // namespace photopic
