#pragma once

#include <optional>

#include "spectral/color.h"

namespace photopic {

/// CIE 1931 chromaticity (of the 2° observer): x = X/(X + Y + Z), y = Y/(X + Y + Z).
struct Chromaticity {
  double x = 0, y = 0;
};
Chromaticity chromaticity(Xyz xyz);

/// The nearest blackbody's temperature.
struct CorrelatedTemperature {
  /// CIE 015:2018: a correlated colour temperature has no meaning farther than this from the Planckian
  /// locus.
  static constexpr double kFarthest = 0.05;

  double kelvin = 0;
  double duv = 0;  ///< signed distance from the Planckian locus in CIE 1960 (u, v); > 0 above it (greenish)
  bool meaningful() const { return duv >= -kFarthest && duv <= kFarthest; }
};

/// The temperature between 1000 and 25,000 K whose blackbody comes nearest in the CIE 1960 (u, v) diagram, to
/// 0.01 K for a blackbody of 3200 K: a scan of the locus and golden-section search in 1/T (CIE 015:2018;
/// sign of Duv: ANSI C78.377-2017). Nothing when the nearest point is an end of that range.
/// @param xyz X + Y + Z > 0, CIE 1931
std::optional<CorrelatedTemperature> correlated_temperature(Xyz xyz);

}  // namespace photopic
