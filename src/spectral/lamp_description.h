#pragma once

#include <optional>
#include <vector>

#include "spectral/color_temperature.h"
#include "spectral/spectrum.h"

namespace photopic {

/// A narrow peak of an emission, above the background it stands on.
struct EmissionLine {
  double wavelength = 0;       ///< of the peak [nm]
  double fwhm = 0;             ///< full width at half its height above the background [nm]
  double power_share = 0;      ///< of the lamp's power from 360 to 830 nm, 0 … 1
  double luminance_share = 0;  ///< of the lamp's luminance, 0 … 1
};

/// The lines of an emission, by wavelength. The rule: a line is a maximum whose two feet are the lowest
/// places within 15 nm on either side (before the next peak, where the valley between is three quarters of
/// its height deep); the background is as high as the higher foot. It counts as a line when it is at most 12
/// nm wide at half its height above the background, a fifth of the background high, and holds 0.2 % of the
/// power.
/// @param emission as tabulate_emission makes it, not zero
std::vector<EmissionLine> find_lines(const TabulatedSpectrum& emission);

/// What a person wants to know of a lamp; CIE 1931 observer.
struct LampDescription {
  Chromaticity chromaticity;
  std::optional<CorrelatedTemperature> temperature;  ///< nothing beyond 1000 … 25,000 K
  double efficacy = 0;         ///< luminous efficacy of its radiation from 360 to 830 nm [lm/W]
  double luminance_from = 0;   ///< 5 % of the luminance lie below this wavelength [nm]
  double luminance_to = 0;     ///< and 5 % above this one [nm]
  std::optional<double> peak;  ///< wavelength of the largest value [nm]; nothing when all are alike
  std::vector<EmissionLine> lines;
};

/// @param emission as tabulate_emission makes it
/// @throws std::invalid_argument when it has no luminance
LampDescription describe_lamp(const TabulatedSpectrum& emission);

}  // namespace photopic
