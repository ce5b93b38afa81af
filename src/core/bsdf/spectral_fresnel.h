#pragma once

#include "core/bsdf/fresnel.h"
#include "core/bsdf/fresnel_albedo.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

/// A film on a share of the surface.
template <int N>
struct SurfaceFilm {
  float share = 0.0f;  ///< in [0, 1]
  float ior = 1.3f;
  SampledSpectrum<N> phase{0.0f};    ///< 2π·thickness/λ
  SampledSpectrum<N> outside{1.0f};  ///< index of the medium around
};

/// The Fresnel term of an opaque surface at a path's wavelengths: Schlick's, or a metal's exact one; with a
/// film on it, Airy's sum over the film's bounces.
template <int N>
class SpectralFresnel {
 public:
  SpectralFresnel() = default;
  /// @param f0, f90 reflectances at normal and grazing incidence
  static SpectralFresnel schlick(SampledSpectrum<N> f0, SampledSpectrum<N> f90) {
    SpectralFresnel f;
    f.f0_ = f0, f.f90_ = f90;
    return f;
  }
  /// @param n, k over the index of the medium outside
  static SpectralFresnel conductor(SampledSpectrum<N> n, SampledSpectrum<N> k) {
    SpectralFresnel f;
    f.is_conductor_ = true;
    f.n_ = n, f.k_ = k;
    return f;
  }
  /// Beneath the film Schlick's term becomes the exact one of the dielectric that has its f0, times f90.
  void put_on(const SurfaceFilm<N>& film) {
    film_ = film;
    if (is_conductor_ || film.share == 0.0f) return;
    for (int j = 0; j < N; ++j) {
      const float root = std::min(std::sqrt(f90_[j] > 0.0f ? f0_[j] / f90_[j] : 0.0f), 0.9999f);
      n_.v[j] = (1.0f + root) / (1.0f - root);
    }
  }

  /// Whether it is Schlick's term.
  bool is_schlick() const { return !is_conductor_ && film_.share == 0.0f; }

  SampledSpectrum<N> operator()(float cos_theta) const {
    SampledSpectrum<N> f = bare(cos_theta);
    if (film_.share > 0.0f) f = f * (1.0f - film_.share) + filmed(cos_theta) * film_.share;
    return f;
  }

 private:
  SampledSpectrum<N> bare(float cos_theta) const {
    if (!is_conductor_) {
      const float w = schlick_weight(cos_theta);
      return f0_ * (1.0f - w) + f90_ * w;
    }
    SampledSpectrum<N> f;
    for (int j = 0; j < N; ++j) f.v[j] = fresnel_conductor(cos_theta, n_[j], k_[j]);
    return f;
  }

  SampledSpectrum<N> filmed(float cos_theta) const {
    SampledSpectrum<N> f;
    for (int j = 0; j < N; ++j) {
      const float outside = film_.outside[j];
      f.v[j] = ThinFilm{outside, film_.ior, {n_[j] * outside, k_[j] * outside}, film_.phase[j]}.reflectance(
          cos_theta);
    }
    return is_conductor_ ? f : f * f90_;
  }

  bool is_conductor_ = false;
  SampledSpectrum<N> f0_{0.0f}, f90_{0.0f};
  SampledSpectrum<N> n_{1.0f}, k_{0.0f};  ///< over the index outside
  SurfaceFilm<N> film_;
};

/// A Fresnel term with its albedos on a rough surface.
template <int N>
class FresnelFit {
 public:
  FresnelFit() = default;
  explicit FresnelFit(const SpectralFresnel<N>& fresnel)
      : fresnel_(fresnel), plain_(fresnel.is_schlick()), f0_(fresnel(1.0f)), f90_(fresnel(0.0f)) {
    if (plain_) return;
    for (int k = 0; k < FresnelAlbedo::kNodes; ++k) {
      const float c = FresnelAlbedo::node(k), w = schlick_weight(c);
      rest_[static_cast<std::size_t>(k)] = fresnel(c) - f0_ * (1.0f - w) - f90_ * w;
    }
  }

  SampledSpectrum<N> operator()(float cos_theta) const { return fresnel_(cos_theta); }

  /// Whether there is a rest besides Schlick's part.
  bool has_rest() const { return !plain_; }

  /// The term as the albedos have it: linear between nodes but for Schlick's part. Over a base that takes
  /// what is not reflected this one keeps energy exactly.
  SampledSpectrum<N> fitted(float cos_theta) const {
    return plain_ ? fresnel_(cos_theta) : albedo(FresnelAlbedo::at(cos_theta));
  }

  SampledSpectrum<N> albedo(const FresnelAlbedo::Weights& e) const {
    SampledSpectrum<N> sum = f0_ * e.f0 + f90_ * e.f90;
    if (!plain_)
      for (std::size_t k = 0; k < rest_.size(); ++k) sum += rest_[k] * e.rest[k];
    return sum;
  }

  /// Kulla & Conty 2017, the colour of all further bounces; 1 where F is. @param e cosine-averaged weights
  SampledSpectrum<N> further_bounces(const FresnelAlbedo::Weights& e) const {
    const SampledSpectrum<N> average = albedo(smooth_average()), one(1.0f);
    return average * average * (1.0f - e.missing) / (one - average * e.missing);
  }

  /// The weights of the cosine-weighted average of F, 2∫F μ dμ.
  static const FresnelAlbedo::Weights& smooth_average() {
    static const FresnelAlbedo::Weights average = [] {
      constexpr int kSteps = 2000;
      FresnelAlbedo::Weights sum;
      for (int i = 0; i < kSteps; ++i) {
        const float mu = (static_cast<float>(i) + 0.5f) / kSteps;
        sum.add(FresnelAlbedo::at(mu), 2.0f * mu / kSteps);
      }
      return sum;
    }();
    return average;
  }

 private:
  SpectralFresnel<N> fresnel_;
  bool plain_ = true;
  SampledSpectrum<N> f0_{0.0f}, f90_{0.0f};
  std::array<SampledSpectrum<N>, FresnelAlbedo::kNodes> rest_;
};

}  // namespace photopic
