#pragma once

#include "core/surface.h"

namespace photopic {

/// A surface's parameters at one hit and at a path's wavelengths: what BSDFs are made from. Each is looked up
/// when it is asked for, so that no BSDF pays for what it does not use. Lives as long as its surface.
template <int N>
class ShadingMaterial {
 public:
  ShadingMaterial(const Surface& surface, SampledSpectrum<N> lambda) : surface_(surface), lambda_(lambda) {}

  const Surface& surface() const { return surface_; }
  SampledSpectrum<N> lambda() const { return lambda_; }  ///< [nm]

  /// Reflectance in [0, 1].
  SampledSpectrum<N> base_color() const { return sample_spectrum<N>(surface_.base_color, lambda_); }
  SampledSpectrum<N> specular_color() const { return sample_spectrum<N>(surface_.specular_color, lambda_); }

  float roughness() const { return surface_.roughness; }  ///< perceptual; GGX α is its square
  float specular() const { return surface_.specular; }

  /// Of the mix m·metal + (1 − m)·((1 − t)·diffuse + t·glass), what remains when glass was not chosen.
  float opaque_metallic() const {
    const float glass = glass_probability();
    if (glass == 0.0f) return surface_.metallic;
    return glass < 1.0f ? surface_.metallic / (1.0f - glass) : 0.0f;
  }

  float glass_probability() const { return surface_.transmission * (1.0f - surface_.metallic); }

  /// glTF's mixes are linear in metallic and transmission, so one of the two BSDFs may stand for both, chosen
  /// with probability transmission·(1 − metallic) for glass. @param u in [0, 1)
  BsdfKind choose_kind(float u) const {
    return surface_.transmits && u < glass_probability() ? surface_.glass_kind : surface_.opaque_kind;
  }

 private:
  const Surface& surface_;
  SampledSpectrum<N> lambda_;
};

}  // namespace photopic
