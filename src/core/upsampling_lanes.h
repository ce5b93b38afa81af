#pragma once

#include "core/math.h"
#include "core/spectrum_lanes.h"
#include "spectral/rgb_upsampling.h"

namespace photopic {

/// Sigmoid polynomials, one a lane.
struct SigmoidLanes {
  Lanes c0, c1, c2;

  /// @param lambda [nm]
  template <int N>
  PHOTOPIC_INLINE SpectrumLanes<N> operator()(const SpectrumLanes<N>& lambda) const {
    return SpectrumLanes<N>::each([this](const Lanes& nm) { return SigmoidPolynomial::at(nm, c0, c1, c2); },
                                  lambda);
  }
};

/// The same as the function of three floats, of 16 colours: linear sRGB, clamped to [0, 1], NaN to 0.
SigmoidLanes tabulated_reflectance(const Vec3Lanes& rgb);

}  // namespace photopic
