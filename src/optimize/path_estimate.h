#pragma once

#include <functional>
#include <span>
#include <vector>

#include "optimize/target_table.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// What one path estimates of surfaces under a lamp, scaled to Y = 1 for R = 1.
class PathEstimate {
 public:
  /// @param sampler must outlive this  @throws std::invalid_argument when the emission has no luminance
  PathEstimate(const WavelengthSampler& sampler, const TabulatedSpectrum& emission);

  /// Traces the path of one u in [0, 1).
  void draw(double u);

  /// Draws u by a two-point Gauss–Legendre rule in every piece in which what a path estimates is smooth;
  /// calls visit(share) after each. The shares add up to 1.
  void integrate_over_u(const std::function<void(double share)>& visit);

  std::span<const double> lambda() const { return lambda_; }  ///< the path's wavelengths [nm]
  std::span<const Xyz> weight() const { return weight_; }     ///< what X, Y, Z gain at each for R = 1
  Xyz white() const;                                          ///< E(u) for R = 1
  Xyz seen(const Spectrum& reflectance) const;                ///< E(u) for a reflectance

  /// What seen() is on average: scale·∫ h I R dλ.
  Xyz expected(const Spectrum& reflectance) const;

 private:
  const WavelengthSampler& sampler_;
  Emitter emitter_;
  std::vector<double> lambda_, density_sum_;
  std::vector<Xyz> weight_;
};

}  // namespace photopic
