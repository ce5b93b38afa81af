#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "spectral/spectrum.h"

namespace photopic {

/// A named illuminant of CIE 15:2018 (relative power; "A", "D65", "E", "FL11", "HP1", "LED-B1" …), at 5 nm.
/// "F11" is taken for "FL11". Nothing when there is no such name.
std::optional<TabulatedSpectrum> cie_illuminant(std::string_view name);

/// All names that cie_illuminant knows, in the order of the standard.
std::vector<std::string_view> cie_illuminant_names();

}  // namespace photopic
