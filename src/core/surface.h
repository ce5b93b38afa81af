#pragma once

#include <cstdint>
#include <memory>

#include "core/bsdf/glass_albedo.h"
#include "core/sample_spectrum.h"
#include "core/triangle_point.h"

namespace photopic {

/// Which BSDF shades a hit.
enum class BsdfKind : std::uint8_t { diffuse, opaque, conductor, layered, glass, spectral_glass };
inline constexpr int kBsdfKinds = 6;

/// Of a material where it does not transmit.
BsdfKind opaque_kind_of(const Material& m);

/// A material compiled for shading; ShadingMaterial is what it comes to at a hit. What does not vary over the
/// surface is told by flags, so that it costs nothing. Its tables are left to prepare_albedos: to integrate
/// them takes a while.
struct Surface {
  explicit Surface(const Material& material);

  BsdfKind opaque_kind;  ///< of what does not transmit
  BsdfKind glass_kind;   ///< of what does
  bool scatters;         ///< else it is black all over: paths end there
  bool transmits;        ///< somewhere on it glass may be chosen
  bool emits;
  bool double_sided;
  bool solid;         ///< transmission refracts
  bool encloses;      ///< a medium that rays can enter
  bool lets_through;  ///< light may go on behind it
  bool is_pane;       ///< a thin wall that may let light pass straight on, being smooth somewhere
  bool base_varies, emission_varies;
  bool maps_normals;
  bool coat_has_normals;  ///< clearcoat whose normals differ from the base's
  bool partly_covers;     ///< rays may pass where alpha is below 1

  Spectrum base_color, specular_color;
  Vec3f base_factor, specular_color_factor;  ///< linear sRGB, on textures and vertex colours
  bool base_is_measured;
  bool has_vertex_colors;
  std::shared_ptr<const MaterialTextures> textures;  ///< or none
  AlphaMode alpha_mode;
  float alpha, alpha_cutoff;

  float metallic;
  float roughness;  ///< perceptual
  float transmission;
  float specular, specular_scale;
  float ior;
  Spectrum attenuation_color;
  float attenuation_distance;  ///< [m], over which attenuation_color is left; 0: no absorption
  int priority;                ///< of the medium; where solids overlap the highest is there
  std::shared_ptr<const GlassAlbedo> glass_albedo{};     ///< null where no rough glass refracts
  std::shared_ptr<const MaterialExtensions> extensions;  ///< null where the material has none

  int emission_spectrum;     ///< index into Scene::emission_spectra
  float emission_luminance;  ///< [cd/m²]
  Vec3f emissive_factor;     ///< linear sRGB, on textures
  bool emission_is_measured;
  bool unlit;

  bool absorbs() const { return attenuation_distance > 0.0f; }

  /// Whether the medium's index depends on the wavelength.
  bool disperses() const {
    return extensions && extensions->dispersion && is_dispersive(*extensions->dispersion);
  }
  /// The medium's refractive index. @param lambda [nm]
  float index(float lambda) const {
    if (!extensions || !extensions->dispersion) return ior;
    return static_cast<float>(refractive_index(*extensions->dispersion, lambda));
  }

  /// Linear sRGB, where base_varies or emission_varies.
  Vec3f base_rgb(const TrianglePoint& point) const;
  Vec3f emissive_rgb(const TrianglePoint& point) const;

  /// Asks memory for the texels of a point that will be shaded soon.
  void prefetch(const TrianglePoint& point) const;

  /// The share of rays that meet the surface at a point; 1 unless partly_covers.
  float coverage(const TrianglePoint& point) const;

  /// Beer's law: the transmittance over a distance [m].
  template <int N>
  SampledSpectrum<N> transmittance(SampledSpectrum<N> lambda, float distance) const {
    SampledSpectrum<N> t = sample_spectrum<N>(attenuation_color, lambda);
    for (int j = 0; j < N; ++j) t.v[j] = std::pow(t.v[j], distance / attenuation_distance);
    return t;
  }
};

/// Y of linear sRGB: IEC 61966-2-1.
inline float luminance(Vec3f rgb) {
  return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

}  // namespace photopic
