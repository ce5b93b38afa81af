#pragma once

#include <array>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "spectral/piecewise_density.h"
#include "spectral/sampled_spectrum.h"
#include "spectral/wavelength_distribution.h"

namespace photopic {

/// Each sampler draws N wavelengths from N densities with one u, and says S(λ) = Σ_k p_k(λ).

/// Hero wavelength sampling, Wilkie et al. 2014: one uniform hero, the rest equally spaced.
struct UniformWavelengths {
  int count = 4;
};

/// p(λ) ∝ sech²(kSlope·(λ − kCentre)) on [360, 830] nm, u_j = frac(u + j/N): Radziszewski et al. 2009.
struct VisibleWavelengths {
  int count = 4;
  static constexpr double kSlope = 0.0072;  ///< [1/nm]; both as pbrt-v4, util/sampling.h
  static constexpr double kCentre = 538.0;  ///< [nm]
};

/// The base density of the scene's emission; sample j takes the j-th of N strata of equal probability.
struct IlluminantWavelengths {
  int count = 4;
  PiecewiseLinearDensity base;
};

/// The N optimised densities of a WavelengthDistribution.
class OptimizedWavelengths {
 public:
  explicit OptimizedWavelengths(const WavelengthDistribution& distribution);
  const PiecewiseLinearDensity& base() const { return base_; }
  const std::vector<PiecewiseLinearDensity>& densities() const { return densities_; }  ///< q_k on t
  const std::vector<bool>& backwards() const { return backwards_; }
  int count() const { return static_cast<int>(densities_.size()); }
  void draw(double u, std::span<double> lambda, std::span<double> density_sum) const;
  double density_sum(double lambda) const;
  std::vector<double> breakpoints(
      std::span<const double> knots) const;  ///< as the free function, neither cut nor sorted

 private:
  PiecewiseLinearDensity base_;
  std::vector<PiecewiseLinearDensity> densities_;
  std::vector<bool> backwards_;
  PiecewiseLinearDensity mean_;  ///< Σ_k q_k / N
};

using WavelengthSampler =
    std::variant<UniformWavelengths, VisibleWavelengths, IlluminantWavelengths, OptimizedWavelengths>;

/// Those that need no search: uniform, visible and illuminant, in this order.
std::array<WavelengthSampler, 3> baseline_samplers(int count, const TabulatedSpectrum& light);

int wavelength_count(const WavelengthSampler& sampler);
std::string_view sampler_name(const WavelengthSampler& sampler);

/// Draws the N wavelengths of one path. @param u in [0, 1); spans of wavelength_count(sampler) entries
void draw_wavelengths(const WavelengthSampler& sampler, double u, std::span<double> lambda,
                      std::span<double> density_sum);

/// S(λ) = Σ_k p_k(λ) [1/nm], zero outside [360, 830] nm.
double density_sum(const WavelengthSampler& sampler, double lambda);

/// The u in (0, 1), sorted, where some λ_j(u) meets a knot of its density or wraps round: between two of them
/// the estimator is smooth where the emission and observer are; quadrature splits there (and at `knots`,
/// wavelengths [nm]).
std::vector<double> breakpoints(const WavelengthSampler& sampler, std::span<const double> knots);

template <int N>
SampledWavelengths<N> sample_wavelengths(const WavelengthSampler& sampler, double u) {
  SampledWavelengths<N> w;
  draw_wavelengths(sampler, u, w.lambda, w.density_sum);
  return w;
}

}  // namespace photopic
