#pragma once

#include "core/prepared_scene.h"

namespace photopic {

/// Light goes straight on through a smooth thin wall of glass, so where a lamp has a size, BSDF sampling
/// finds it through a pane. It never finds a point, spot or directional light: their shadow rays pass panes
/// instead.

/// Whether a scene has such lights and walls.
bool has_panes_before_lights(const PreparedScene& scene);

/// The share of a shadow ray's light that arrives at each wavelength [nm]: 0 where anything but smooth thin
/// walls is in the way. @param t_max the ray's end, in lengths of its direction
template <int N>
SampledSpectrum<N> through_panes(const PreparedScene& scene, Ray ray, float t_max, SampledSpectrum<N> lambda);

}  // namespace photopic
