#pragma once

#include <string>

#include "core/prepared_scene.h"
#include "spectral/color.h"
#include "spectral/observer.h"

namespace photopic {

/// What carries colours to sRGB: light of the given SPECTRUM comes out as its white. "illuminant" stands for
/// the scene's lamps together, nothing for D65, which for the 1931 observer changes no bit.
/// @throws InputError when there is no such spectrum, or no eye adapts to its colour
ChromaticAdaptation white_balance(const std::string& spectrum, const Observer& observer,
                                  const PreparedScene& scene);

}  // namespace photopic
