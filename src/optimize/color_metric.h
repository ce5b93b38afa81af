#pragma once

#include <array>

#include "spectral/color.h"

namespace photopic {

/// The rows of an upper triangular U: near a colour c, ΔE00(c, c + δ)² = |U δ|² to leading order, δ in XYZ.
using ColorMetric = std::array<Xyz, 3>;

/// The Cholesky factor of J, half the Hessian of ΔE00(c, ·)² at c, by central differences.
/// Of black it is zero. @param white the white of CIELAB, on the scale of c
ColorMetric color_metric(Xyz c, Xyz white);

/// U δ: a small difference of colour, in ΔE along three axes.
Xyz measured(const ColorMetric& u, Xyz delta);

/// ΔE00 with its kink at 0 rounded off: sqrt(ΔE² + ε²) − ε with ε = 0.1, and its gradient by the sample's
/// XYZ.
struct SmoothDeltaE {
  double value;
  Xyz gradient;
};
SmoothDeltaE smooth_delta_e(const Lab& reference, Xyz sample, Xyz white);

}  // namespace photopic
