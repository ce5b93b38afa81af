#pragma once

#include <cstdint>
#include <vector>

#include "spectral/piecewise_density.h"

namespace photopic {

/// p(λ) = q(B(λ))·b(λ), q a density on t in [0, 1] and B the CDF of b, compiled for drawing: the pieces on
/// which both are linear, each in one cache line, so that λ = B⁻¹(Q⁻¹(u)) costs one look-up and two square
/// roots.
class ComposedDensity {
 public:
  /// @param q_sum values of a function of t at q's knots, linear between them, to be returned with each draw
  ComposedDensity(const PiecewiseLinearDensity& base, const PiecewiseLinearDensity& q,
                  const std::vector<double>& q_sum);

  struct Draw {
    double lambda;
    double density_sum;  ///< q_sum(B(λ))·b(λ)
  };
  Draw draw(double u) const;  ///< u in [0, 1]

 private:
  /// From u on, where t = t_0 + dt and λ = lambda + dλ, the densities are q + q_slope·dt and b + b_slope·dλ.
  struct alignas(64) Piece {
    double u = 0, q = 0, q_slope = 0, lambda = 0, b = 0, b_slope = 0, sum = 0, sum_slope = 0;
  };
  void add_pieces(const PiecewiseLinearDensity& base, std::size_t knot, const PiecewiseLinearDensity& q,
                  const std::vector<double>& q_sum);
  void build_guide();

  std::vector<Piece> pieces_;  ///< and behind them their end, u beyond 1
  std::vector<std::uint32_t> guide_;
  double guide_scale_ = 0;
};

}  // namespace photopic
