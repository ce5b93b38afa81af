#include "core/surface.h"

#include "core/microfacet.h"

namespace photopic {

namespace {

BsdfKind opaque_kind_of(const Material& m) {
  if (m.extensions.is_layered()) return BsdfKind::layered;
  if (m.extensions.conductor) return BsdfKind::conductor;
  return m.metallic == 0.0f && m.specular == 0.0f ? BsdfKind::diffuse : BsdfKind::opaque;
}

BsdfKind glass_kind_of(const Material& m) {
  return m.extensions.is_spectral_glass() && m.ior != 0.0f ? BsdfKind::spectral_glass : BsdfKind::glass;
}

std::shared_ptr<const MaterialExtensions> extensions_of(const Material& m) {
  return m.extensions.any() ? std::make_shared<const MaterialExtensions>(m.extensions) : nullptr;
}

GlassAlbedo::Range ior_range(const Material& m) {
  if (!m.extensions.dispersion) return {m.ior, m.ior};
  const auto at = [&](double lambda) {
    return static_cast<float>(refractive_index(*m.extensions.dispersion, lambda));
  };
  return {std::max(at(kLambdaMax), kLeastRoughIor), std::max(at(kLambdaMin), kLeastRoughIor)};
}

/// Of rough solid glass alone; where there is no change of index, nothing scatters.
std::shared_ptr<const GlassAlbedo> glass_albedo_of(const Material& m) {
  const bool refracts = m.transmission > 0.0f && m.metallic < 1.0f && !m.thin_walled;
  if (!refracts || sqr(m.roughness) < kSmoothAlpha || ior_range(m).high < kLeastRoughIor) return nullptr;
  return std::make_shared<const GlassAlbedo>(ior_range(m), GlassAlbedo::Range{m.roughness, m.roughness});
}

}  // namespace

Surface::Surface(const Material& m)
    : opaque_kind(opaque_kind_of(m)),
      glass_kind(glass_kind_of(m)),
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
      glass_albedo(glass_albedo_of(m)),
      extensions(extensions_of(m)),
      emission_spectrum(m.emission_spectrum),
      emission_luminance(m.emission_luminance) {}

}  // namespace photopic
