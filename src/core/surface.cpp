#include "core/surface.h"

namespace photopic {

Surface::Surface(const Material& m)
    : glass_probability(m.transmission * (1.0f - m.metallic)),
      emits(m.emission_spectrum >= 0 && m.emission_luminance > 0.0f),
      double_sided(m.double_sided),
      solid(!m.thin_walled),
      base_color(m.base_color),
      specular_color(m.specular_color),
      // Of the mix m·metal + (1 − m)·((1 − t)·diffuse + t·glass), what remains when glass was not chosen.
      metallic(glass_probability < 1.0f ? m.metallic / (1.0f - glass_probability) : 0.0f),
      roughness(m.roughness),
      alpha(m.roughness * m.roughness),
      specular(m.specular),
      ior(m.ior),
      attenuation_color(m.attenuation_color),
      attenuation_distance(m.attenuation_distance),
      emission_spectrum(m.emission_spectrum),
      emission_luminance(m.emission_luminance) {
  opaque_kind = metallic == 0.0f && specular == 0.0f ? BsdfKind::diffuse : BsdfKind::opaque;
}

}  // namespace photopic
