#pragma once

#include <span>
#include <vector>

#include "spectral/guide_table.h"

namespace photopic {

/// A normalised piecewise linear density on [x_0, x_n]; two knots at one place are a jump. Density, CDF and
/// inverse are one and the same function: CDFs are exact trapezoid sums and the inverse solves the cell's
/// quadratic.
class PiecewiseLinearDensity {
 public:
  /// @param x     knots, non-decreasing, x_0 < x_n
  /// @param value values ≥ 0, finite, not all zero; any scale
  /// @throws std::invalid_argument where that is not so
  PiecewiseLinearDensity(std::vector<double> x, std::vector<double> value);

  double density(double x) const;  ///< [1/unit of x]; zero outside
  double cdf(double x) const;      ///< 0 … 1
  double inverse(double u) const;  ///< the x with cdf(x) = u; u in [0, 1]

  /// One draw with everything a caller needs of its cell.
  struct Draw {
    double x;
    double density;
  };
  Draw draw(double u) const;  ///< u in [0, 1]; never inside a cell without mass

  std::span<const double> x() const { return x_; }
  std::span<const double> value() const { return value_; }  ///< normalised

 private:
  /// A piece of positive width; s to the right of x the density is f + slope·s, the CDF cdf + s·(f +
  /// slope·s/2).
  struct alignas(32) Cell {
    double x, cdf, f, slope;
  };
  void normalise();
  void build_cells();
  void build_guides();
  std::vector<double> x_, value_;
  std::vector<Cell> cells_;    ///< and behind them their end, {x_n, 1, 0, 0}
  std::size_t last_mass_ = 0;  ///< the last cell that is not dark
  GuideTable cell_of_x_, cell_of_u_;
};

}  // namespace photopic
