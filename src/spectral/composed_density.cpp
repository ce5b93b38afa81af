#include "spectral/composed_density.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace photopic {
namespace {

/// Where a linear density f + slope·s has gathered `mass`: the way s, and the density there. The form of the
/// root that neither cancels nor divides by a slope of zero.
struct Way {
  double s, density;
};
Way way_to(double mass, double f, double slope) {
  const double root = std::sqrt(std::max(0.0, f * f + 2.0 * slope * mass));
  const double sum = f + root;
  return {sum > 0.0 ? 2.0 * mass / sum : 0.0, root};
}

}  // namespace

ComposedDensity::ComposedDensity(const PiecewiseLinearDensity& base, const PiecewiseLinearDensity& q,
                                 const std::vector<double>& q_sum) {
  for (std::size_t i = 0; i + 1 < base.x().size(); ++i) add_pieces(base, i, q, q_sum);
  pieces_.push_back({.u = std::numeric_limits<double>::infinity(), .lambda = base.x().back()});
  build_guide();
}

/// The pieces between two knots of the base: q's knots divide it.
void ComposedDensity::add_pieces(const PiecewiseLinearDensity& base, std::size_t knot,
                                 const PiecewiseLinearDensity& q, const std::vector<double>& q_sum) {
  const double x = base.x()[knot], width = base.x()[knot + 1] - x;
  const double first = base.cdf(x), last = base.cdf(base.x()[knot + 1]);
  if (!(width > 0.0 && last > first)) return;
  const double f = base.value()[knot], slope = (base.value()[knot + 1] - f) / width;

  const auto t = q.x();
  auto node = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), first) - t.begin()) - 1;
  for (double start = first; start < last; start = t[++node]) {
    const double step = t[node + 1] - t[node], beyond = start - t[node];
    const double q_slope = (q.value()[node + 1] - q.value()[node]) / step;
    const double sum_slope = (q_sum[node + 1] - q_sum[node]) / step;
    const Way way = way_to(start - first, f, slope);
    pieces_.push_back({.u = q.cdf(start),
                       .q = q.value()[node] + q_slope * beyond,
                       .q_slope = q_slope,
                       .lambda = x + way.s,
                       .b = way.density,
                       .b_slope = slope,
                       .sum = q_sum[node] + sum_slope * beyond,
                       .sum_slope = sum_slope});
  }
}

/// The last piece that begins at or before each of equal steps of u, a hair early for the rounding of a
/// look-up.
void ComposedDensity::build_guide() {
  const std::size_t size = std::bit_ceil(4 * pieces_.size());
  guide_scale_ = static_cast<double>(size);
  guide_.reserve(size + 1);
  std::uint32_t piece = 0;
  for (std::size_t i = 0; i <= size; ++i) {
    while (pieces_[piece + 1].u <= static_cast<double>(i) / guide_scale_) ++piece;
    guide_.push_back(piece);
  }
}

ComposedDensity::Draw ComposedDensity::draw(double u) const {
  std::size_t i = guide_[static_cast<std::size_t>(u * guide_scale_)];
  while (pieces_[i + 1].u <= u) ++i;
  const Piece& p = pieces_[i];
  const Way t = way_to(std::max(0.0, u - p.u), p.q, p.q_slope);
  const Way lambda = way_to(t.s, p.b, p.b_slope);
  return {std::min(p.lambda + lambda.s, pieces_[i + 1].lambda), (p.sum + p.sum_slope * t.s) * lambda.density};
}

}  // namespace photopic
