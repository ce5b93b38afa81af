#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spectral/piecewise_density.h"

namespace photopic {

/// N densities p_k(λ) = q_k(B(λ))·b(λ), q_k on t in [0, 1] and B the CDF of b, compiled for drawing: the
/// pieces on which both are linear, each in one cache line, so that λ = B⁻¹(Q_k⁻¹(u)) costs one look-up, in a
/// guide that all N share, and two square roots.
class ComposedDensities {
 public:
  /// @param q N densities with the same knots  @param backwards N orientations: density k is driven by 1 − u
  ComposedDensities(const PiecewiseLinearDensity& base, std::span<const PiecewiseLinearDensity> q,
                    const std::vector<bool>& backwards);

  /// @param u in [0, 1]  @param lambda N wavelengths  @param density_sum N sums S(λ) = Σ_k p_k(λ)
  void draw(double u, std::span<double> lambda, std::span<double> density_sum) const;

 private:
  /// From u on, where t = t_0 + dt and λ = lambda + dλ, the densities are q + q_slope·dt and b + b_slope·dλ,
  /// and Σ_k q_k is sum + sum_slope·dt.
  struct alignas(64) Piece {
    double u = 0, lambda = 0, q = 0, q_slope = 0, b = 0, b_slope = 0, sum = 0, sum_slope = 0;
  };
  struct Density {
    std::vector<Piece> pieces;  ///< and behind them their end, u beyond 1
    bool backwards = false;

    double driven_by(double u) const { return backwards ? 1.0 - u : u; }
    std::uint32_t piece_at(double v) const;  ///< by a search
  };
  static void add_pieces(const PiecewiseLinearDensity& base, std::size_t knot,
                         const PiecewiseLinearDensity& q, std::span<const double> q_sum,
                         std::vector<Piece>& pieces);
  void build_guide();
  /// @param v what drives density k @param guide of the step that u lies in
  const Piece* piece_at(std::size_t k, double v, const std::uint32_t* guide) const;

  std::vector<Density> densities_;
  double steps_ = 0;                  ///< of u
  std::vector<std::uint32_t> guide_;  ///< N for each step: a density's first piece there
};

}  // namespace photopic
