#include "core/surface.h"

namespace photopic {

Surface::Surface(const Material& m)
    : opaque_kind(m.metallic == 0.0f && m.specular == 0.0f ? BsdfKind::diffuse : BsdfKind::opaque),
      transmits(m.transmission > 0.0f && m.metallic < 1.0f),
      emits(m.emission_spectrum >= 0 && m.emission_luminance > 0.0f),
      double_sided(m.double_sided),
      solid(!m.thin_walled),
      base_color(m.base_color),
      specular_color(m.specular_color),
      metallic(m.metallic),
      roughness(m.roughness),
      transmission(m.transmission),
      specular(m.specular),
      ior(m.ior),
      attenuation_color(m.attenuation_color),
      attenuation_distance(m.attenuation_distance),
      emission_spectrum(m.emission_spectrum),
      emission_luminance(m.emission_luminance) {}

}  // namespace photopic
