#pragma once

#include <string>

#include "spectral/spectrum.h"

namespace photopic {

/// The lamp as a table that gives some visible light.
/// @param where what the message names @throws InputError where it gives none, or is no lamp
TabulatedSpectrum visible_lamp(const Spectrum& spectrum, const std::string& where);

}  // namespace photopic
