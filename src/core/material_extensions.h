#pragma once

#include <optional>

#include "spectral/refractive_index.h"

namespace photopic {

/// What few materials have: glTF's further KHR_materials_*, and measured indices by name. The defaults change
/// nothing.
struct MaterialExtensions {
  std::optional<ConductorIndex> conductor;  ///< takes the place of the base colour; the surface is all metal
  std::optional<DielectricIndex> dispersion;  ///< takes the place of Material::ior where light is transmitted

  float clearcoat = 0.0f;
  float clearcoat_roughness = 0.0f;  ///< perceptual
  Spectrum sheen_color = ConstantSpectrum{0.0};
  float sheen_roughness = 0.0f;       ///< perceptual
  float anisotropy = 0.0f;            ///< strength in [0, 1]
  float anisotropy_rotation = 0.0f;   ///< of the direction of least sharpness against the tangent [rad]
  float iridescence = 0.0f;           ///< share of the surface that has the film, in [0, 1]
  float iridescence_ior = 1.3f;       ///< ≥ 1
  float iridescence_thickness = 400;  ///< [nm]; where a texture is white, if there is one
  float thinnest_film = 100;          ///< [nm]; where it is black
  float diffuse_transmission = 0.0f;
  Spectrum diffuse_transmission_color = ConstantSpectrum{1.0};

  bool has_sheen() const {
    const auto* constant = std::get_if<ConstantSpectrum>(&sheen_color);
    return constant == nullptr || constant->value > 0.0;
  }
  /// Whether the opaque part is more than a base of one colour under a rough surface.
  bool is_layered() const {
    return clearcoat > 0.0f || has_sheen() || anisotropy > 0.0f || iridescence > 0.0f ||
           diffuse_transmission > 0.0f;
  }
  /// Whether what transmits looks different at different wavelengths.
  bool is_spectral_glass() const { return iridescence > 0.0f || (dispersion && is_dispersive(*dispersion)); }
  bool any() const { return is_layered() || conductor || dispersion; }
};

}  // namespace photopic
