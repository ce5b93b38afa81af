#pragma once

#include <cstdint>
#include <memory>

#include "core/glass_albedo.h"
#include "core/sample_spectrum.h"
#include "core/scene.h"

namespace photopic {

/// Which BSDF shades a hit.
enum class BsdfKind : std::uint8_t { diffuse, opaque, conductor, layered, glass, spectral_glass };
inline constexpr int kBsdfKinds = 6;

/// A material compiled for shading; ShadingMaterial is what it comes to at a hit.
struct Surface {
  explicit Surface(const Material& material);

  BsdfKind opaque_kind;  ///< of what does not transmit
  BsdfKind glass_kind;   ///< of what does
  bool transmits;        ///< somewhere on it glass may be chosen
  bool emits;
  bool double_sided;
  bool solid;  ///< encloses a medium: transmission refracts

  Spectrum base_color, specular_color;
  float metallic;
  float roughness;  ///< perceptual
  float transmission;
  float specular;
  float ior;
  Spectrum attenuation_color;
  float attenuation_distance;
  std::shared_ptr<const GlassAlbedo> glass_albedo;       ///< null where no rough glass refracts
  std::shared_ptr<const MaterialExtensions> extensions;  ///< null where the material has none
  int emission_spectrum;
  float emission_luminance;

  bool absorbs() const { return attenuation_distance > 0.0f; }

  /// Beer's law: the transmittance over a distance [m].
  template <int N>
  SampledSpectrum<N> transmittance(SampledSpectrum<N> lambda, float distance) const {
    SampledSpectrum<N> t = sample_spectrum<N>(attenuation_color, lambda);
    for (int j = 0; j < N; ++j) t.v[j] = std::pow(t.v[j], distance / attenuation_distance);
    return t;
  }
};

}  // namespace photopic
