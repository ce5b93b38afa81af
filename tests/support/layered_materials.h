#pragma once

#include "support/scene_builder.h"

namespace photopic::test {

/// Materials with one layer more. Roughness is perceptual.

inline Material coated(Material m, float roughness, float coat = 1.0f) {
  m.extensions.clearcoat = coat;
  m.extensions.clearcoat_roughness = roughness;
  return m;
}
inline Material with_sheen(Material m, float roughness, double color = 0.8) {
  m.extensions.sheen_color = ConstantSpectrum{color};
  m.extensions.sheen_roughness = roughness;
  return m;
}
inline Material brushed(Material m, float strength) {
  m.extensions.anisotropy = strength;
  m.extensions.anisotropy_rotation = 0.4f;
  return m;
}
/// @param thickness [nm]
inline Material iridescent(Material m, float thickness, float share = 1.0f) {
  m.extensions.iridescence = share;
  m.extensions.iridescence_ior = 1.8f;
  m.extensions.iridescence_thickness = thickness;
  return m;
}
inline Material translucent(Material m, float share = 0.3f) {
  m.extensions.diffuse_transmission = share;
  return m;
}
inline Material of_metal(const char* name, float roughness) {
  Material m = metal(ConstantSpectrum{1.0}, roughness);
  m.extensions.conductor = conductor_index(name);
  return m;
}
/// A metal of so large a k that it reflects all.
inline Material perfect_conductor(float roughness) {
  Material m = metal(ConstantSpectrum{1.0}, roughness);
  m.extensions.conductor =
      ConductorIndex{{{400.0}, {1e-3}, Beyond::end_value}, {{400.0}, {300.0}, Beyond::end_value}};
  return m;
}
/// Every layer at once.
inline Material everything(const Material& base, float coat_roughness = 0.3f) {
  return coated(with_sheen(brushed(iridescent(translucent(base), 500.0f), 0.5f), 0.6f), coat_roughness);
}
inline Material dispersive(Material m, const char* glass) {
  m.extensions.dispersion = glass_index(glass);
  return m;
}

}  // namespace photopic::test
