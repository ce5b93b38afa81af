#pragma once

#include "core/prepared_scene.h"

namespace photopic {

/// Light goes straight on through a smooth thin wall of glass, so lamps behind it are found both by BSDF
/// sampling, for which such a pane is as good as none, and by shadow rays, which pass it. Panes that touch
/// solid glass are a surface of it: no shadow ray passes.

/// No room has more.
inline constexpr int kMostPanes = 64;

bool has_panes(const PreparedScene& scene);

/// The share of light that arrives at each wavelength [nm] of a shadow ray that is in the shadow of panes
/// alone (what covers in part has let it pass): 0 where anything but smooth thin walls is in the way, or more
/// of them than are allowed. @param t_max the ray's end, in lengths of its direction
template <int N>
SampledSpectrum<N> through_panes(const PreparedScene& scene, Ray ray, float t_max, SampledSpectrum<N> lambda,
                                 int most);

}  // namespace photopic
