#pragma once

#include <string>
#include <vector>

#include "core/prepared_scene.h"
#include "spectral/wavelength_sampler.h"
#include "support/scene_builder.h"

namespace photopic::test {

/// Two named spectra to light scenes with: lines (CIE FL11) and daylight (CIE D65).
Spectrum fl11();
Spectrum d65();

/// A closed room of 2 m, walls of several colours, a lamp of 1.8 m and 10 cd/m² under the ceiling, seen from
/// inside; nothing stands in it yet.
SceneBuilder lamp_room(const Spectrum& lamp, int resolution = 16);

/// The room with a glowing box and a sphere of plain diffuse; with metal, plastic and a lamp of two sides;
/// with smooth and rough glass that absorbs.
SceneBuilder diffuse_room(int resolution = 16);
SceneBuilder glossy_room(int resolution = 16);
SceneBuilder glass_room(int resolution = 16);

/// The four samplers for a scene's emission; the optimised one has arbitrary nodes, every other density
/// running backwards.
std::vector<WavelengthSampler> all_samplers(const TabulatedSpectrum& emission, int count = 4);
WavelengthSampler arbitrary_distribution(const TabulatedSpectrum& emission, int count = 4);

}  // namespace photopic::test
