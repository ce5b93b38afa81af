#pragma once

#include <cmath>

#include "core/surface.h"
#include "spectral/rgb_table.h"

namespace photopic {

/// A surface's parameters at one hit and at a path's wavelengths: what BSDFs are made from. Each is looked up
/// when it is asked for, so that no BSDF pays for what it does not use. Lives as long as its surface and the
/// geometry of its point.
template <int N>
class ShadingMaterial {
 public:
  /// @param outside what bounds the medium in front of the surface; null: the index there is 1
  ShadingMaterial(const Surface& surface, SampledSpectrum<N> lambda, const TrianglePoint& point = {},
                  const Surface* outside = nullptr)
      : surface_(surface), lambda_(lambda), point_(point), outside_(outside) {}

  const Surface& surface() const { return surface_; }
  SampledSpectrum<N> lambda() const { return lambda_; }  ///< [nm]

  /// The refractive index in front of the surface.
  bool in_vacuum() const { return outside_ == nullptr; }
  float outside_index(float lambda) const { return outside_ ? outside_->index(lambda) : 1.0f; }
  SampledSpectrum<N> outside_indices() const {
    SampledSpectrum<N> index(1.0f);
    if (!in_vacuum())
      for (int j = 0; j < N; ++j) index.v[j] = outside_->index(lambda_[j]);
    return index;
  }
  bool outside_disperses() const { return outside_ && outside_->disperses(); }

  /// Linear sRGB, of a surface whose base colour varies and is not measured.
  Vec3f base_rgb() const { return surface_.base_rgb(point_); }

  /// Reflectance in [0, 1].
  SampledSpectrum<N> base_color() const {
    if (!surface_.base_varies) return sample_spectrum<N>(surface_.base_color, lambda_);
    const Vec3f rgb = surface_.base_rgb(point_);
    if (!surface_.base_is_measured) return reflectance(rgb);
    return sample_spectrum<N>(surface_.base_color, lambda_) * std::min(luminance(rgb), 1.0f);
  }

  /// On the reflectance at normal incidence; may be above 1.
  SampledSpectrum<N> specular_color() const {
    const float scale = surface_.specular_scale;
    if (!has(&MaterialTextures::specular_color))
      return sample_spectrum<N>(surface_.specular_color, lambda_) * scale;
    const Vec4f texel = point_.look_up(surface_.textures->specular_color);
    const Vec3f factor = surface_.specular_color_factor;
    return reflectance({factor.x * texel.x, factor.y * texel.y, factor.z * texel.z}) * scale;
  }

  /// Of the opaque dielectric at normal incidence, towards the medium in front; what is above 1 counts as 1.
  SampledSpectrum<N> dielectric_f0() const {
    SampledSpectrum<N> f0 = specular_color();
    if (in_vacuum()) return f0 * normal_reflectance(surface_.ior);
    const SampledSpectrum<N> outside = outside_indices();
    for (int j = 0; j < N; ++j) f0.v[j] *= normal_reflectance(surface_.ior / outside[j]);
    return f0;
  }

  /// Perceptual; GGX α is its square.
  float roughness() const {
    return surface_.roughness * textured(&MaterialTextures::metallic_roughness, &Vec4f::y);
  }
  float specular() const { return surface_.specular * textured(&MaterialTextures::specular, &Vec4f::w); }

  // Of the surface's extensions, which it must have.
  float clearcoat() const {
    return extensions().clearcoat * textured(&MaterialTextures::clearcoat, &Vec4f::x);
  }
  float clearcoat_roughness() const {
    return extensions().clearcoat_roughness * textured(&MaterialTextures::clearcoat_roughness, &Vec4f::y);
  }
  SampledSpectrum<N> sheen_color() const {
    return tinted(extensions().sheen_color, &MaterialTextures::sheen_color);
  }
  float sheen_roughness() const {
    return extensions().sheen_roughness * textured(&MaterialTextures::sheen_roughness, &Vec4f::w);
  }
  struct Grain {
    float strength;  ///< in [0, 1]
    float rotation;  ///< of the direction of least sharpness against the tangent [rad]
  };
  Grain grain() const {
    const Grain whole{extensions().anisotropy, extensions().anisotropy_rotation};
    if (!has(&MaterialTextures::anisotropy)) return whole;
    const Vec4f texel = point_.look_up(surface_.textures->anisotropy);
    return {whole.strength * texel.z,
            whole.rotation + std::atan2(2.0f * texel.y - 1.0f, 2.0f * texel.x - 1.0f)};
  }
  float iridescence() const {
    return extensions().iridescence * textured(&MaterialTextures::iridescence, &Vec4f::x);
  }
  /// [nm]
  float film_thickness() const {
    const float thinnest = extensions().thinnest_film, thickest = extensions().iridescence_thickness;
    return thinnest + (thickest - thinnest) * textured(&MaterialTextures::iridescence_thickness, &Vec4f::y);
  }
  float diffuse_transmission() const {
    return extensions().diffuse_transmission * textured(&MaterialTextures::diffuse_transmission, &Vec4f::w);
  }
  SampledSpectrum<N> diffuse_transmission_color() const {
    return tinted(extensions().diffuse_transmission_color, &MaterialTextures::diffuse_transmission_color);
  }

  /// Of the mix m·metal + (1 − m)·((1 − t)·diffuse + t·glass), what remains when glass was not chosen.
  float opaque_metallic() const {
    const float m = metallic();
    if (!surface_.transmits) return m;
    const float glass = transmission() * (1.0f - m);
    return glass < 1.0f ? m / (1.0f - glass) : 0.0f;
  }

  float glass_probability() const { return surface_.transmits ? transmission() * (1.0f - metallic()) : 0.0f; }

  /// glTF's mixes are linear in metallic and transmission, so one of the two BSDFs may stand for both, chosen
  /// with probability transmission·(1 − metallic) for glass. @param u in [0, 1)
  BsdfKind choose_kind(float u) const {
    if (!surface_.transmits || u >= glass_probability()) return surface_.opaque_kind;
    return surface_.encloses && outside_disperses() ? BsdfKind::spectral_glass : surface_.glass_kind;
  }

  /// Factor on the surface's emission spectrum × luminance: of a texture, else 1.
  SampledSpectrum<N> emission_tint() const {
    if (!surface_.emission_varies) return SampledSpectrum<N>(1.0f);
    const Vec3f rgb = surface_.emissive_rgb(point_);
    return surface_.emission_is_measured ? SampledSpectrum<N>(luminance(rgb)) : reflectance(rgb);
  }

 private:
  bool has(Texture MaterialTextures::*which) const {
    return surface_.textures && (*surface_.textures).*which;
  }
  float textured(Texture MaterialTextures::*which, float Vec4f::*channel) const {
    return has(which) ? point_.look_up((*surface_.textures).*which).*channel : 1.0f;
  }
  const MaterialExtensions& extensions() const { return *surface_.extensions; }
  SampledSpectrum<N> tinted(const Spectrum& factor, Texture MaterialTextures::*which) const {
    const SampledSpectrum<N> color = sample_spectrum<N>(factor, lambda_);
    if (!has(which)) return color;
    const Vec4f texel = point_.look_up((*surface_.textures).*which);
    return color * reflectance({texel.x, texel.y, texel.z});
  }
  float metallic() const {
    return surface_.metallic * textured(&MaterialTextures::metallic_roughness, &Vec4f::z);
  }
  float transmission() const {
    return surface_.transmission * textured(&MaterialTextures::transmission, &Vec4f::x);
  }
  SampledSpectrum<N> reflectance(Vec3f rgb) const {
    return tabulated_reflectance(rgb.x, rgb.y, rgb.z)(lambda_);
  }

  const Surface& surface_;
  SampledSpectrum<N> lambda_;
  TrianglePoint point_;
  const Surface* outside_;
};

}  // namespace photopic
