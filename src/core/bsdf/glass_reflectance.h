#pragma once

#include <array>

#include "core/bsdf/fresnel.h"
#include "core/bsdf/glass_albedo.h"
#include "core/bsdf/microfacet.h"
#include "core/bsdf/shading_material.h"

namespace photopic {

/// What glass reflects at each of a path's wavelengths, its film and KHR_materials_specular included. Cosines
/// are on the side that light comes from.
template <int N>
class GlassReflectance {
 public:
  /// @param inside whether light comes from within  @param rough then no index is quite that of the outside
  GlassReflectance(const ShadingMaterial<N>& m, bool inside, bool rough)
      : solid_(m.surface().solid), inside_(solid_ && inside) {
    const float specular = m.specular();
    const SampledSpectrum<N> specular_color = m.specular_color();
    float thickness = 0.0f;
    if (const MaterialExtensions* x = m.surface().extensions.get(); x && x->iridescence > 0.0f) {
      film_ = m.iridescence(), film_ior_ = x->iridescence_ior;
      thickness = m.film_thickness();
    }
    for (int j = 0; j < N; ++j) {
      ior_.v[j] = m.surface().index(m.lambda()[j]);
      if (solid_) outside_.v[j] = m.outside_index(m.lambda()[j]);
      if (rough && is_index_matched(ior_[j] / outside_[j])) ior_.v[j] = outside_[j] * kLeastRoughIor;
      eta_.v[j] = inside_ ? outside_[j] / ior_[j] : ior_[j] / outside_[j];
      phase_.v[j] = 2.0f * kPi * thickness / m.lambda()[j];
      specular_[static_cast<std::size_t>(j)] = SpecularScale::of(specular, specular_color[j], eta_[j]);
    }
  }

  float eta(int j) const { return eta_[j]; }  ///< n_t/n_i

  /// Of the interface, or of the thin wall.
  SampledSpectrum<N> operator()(float cos_i) const {
    SampledSpectrum<N> f;
    for (int j = 0; j < N; ++j) f.v[j] = solid_ ? of_interface(cos_i, j) : of_wall(cos_i, j);
    return f;
  }
  float of_interface(float cos_i, int j) const {
    float f = fresnel_dielectric(cos_i, eta_[j]);
    if (f == 1.0f) return f;
    if (film_ > 0.0f) f += film_ * (filmed(cos_i, j) - f);
    return specular_of(j).scaled(f, cos_i, eta_[j]);
  }
  /// Between its two sides light goes to and fro.
  float of_wall(float cos_i, int j) const {
    const float f = of_interface(cos_i, j);
    return 2.0f * f / (1.0f + f);
  }

  /// How it differs from that of the bare interface, as the albedo wants it.
  GlassAlbedo::Reflection beyond_bare(int j) const {
    GlassAlbedo::Reflection reflection{specular_of(j), {}};
    if (film_ > 0.0f) reflection.film = film_difference(j);
    return reflection;
  }

 private:
  const SpecularScale& specular_of(int j) const { return specular_[static_cast<std::size_t>(j)]; }
  float filmed(float cos_i, int j) const {
    const float from = inside_ ? ior_[j] : outside_[j], to = inside_ ? outside_[j] : ior_[j];
    return ThinFilm{from, film_ior_, {to}, phase_[j]}.reflectance(cos_i);
  }

  /// What the film adds; alike from either side.
  GlassAlbedo::Film film_difference(int j) const {
    const float thin = std::min(ior_[j], outside_[j]), dense = std::max(ior_[j], outside_[j]);
    GlassAlbedo::Film film;
    for (int k = 0; k < GlassAlbedo::kFilmNodes; ++k) {
      const float c = GlassAlbedo::film_node(k), bare = fresnel_dielectric(c, dense / thin);
      const float filmed = ThinFilm{thin, film_ior_, {dense}, phase_[j]}.reflectance(c);
      film[static_cast<std::size_t>(k)] =
          specular_of(j).scaled(bare + film_ * (filmed - bare), c, dense / thin) -
          specular_of(j).scaled(bare, c, dense / thin);
    }
    return film;
  }

  bool solid_, inside_;
  std::array<SpecularScale, N> specular_;
  float film_ = 0.0f, film_ior_ = 1.0f;
  SampledSpectrum<N> ior_;
  SampledSpectrum<N> outside_{1.0f};  ///< index of the medium in front
  SampledSpectrum<N> eta_;
  SampledSpectrum<N> phase_;  ///< of the film: 2π·thickness/λ
};

}  // namespace photopic
