#include "spectral/composed_densities.h"

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
  return {2.0 * mass / (f + root + std::numeric_limits<double>::min()), root};
}

}  // namespace

ComposedDensities::ComposedDensities(const PiecewiseLinearDensity& base,
                                     std::span<const PiecewiseLinearDensity> q,
                                     const std::vector<bool>& backwards) {
  std::vector<double> q_sum(q.front().value().size());
  for (const PiecewiseLinearDensity& one : q)
    for (std::size_t i = 0; i < q_sum.size(); ++i) q_sum[i] += one.value()[i];

  for (std::size_t k = 0; k < q.size(); ++k) {
    Density density{.pieces = {}, .guide = {}, .backwards = backwards[k]};
    for (std::size_t i = 0; i + 1 < base.x().size(); ++i) add_pieces(base, i, q[k], q_sum, density.pieces);
    density.pieces.push_back({.u = std::numeric_limits<double>::infinity(), .lambda = base.x().back()});
    build_guide(density);
    densities_.push_back(std::move(density));
  }
}

/// The pieces between two knots of the base: q's knots divide it.
void ComposedDensities::add_pieces(const PiecewiseLinearDensity& base, std::size_t knot,
                                   const PiecewiseLinearDensity& q, std::span<const double> q_sum,
                                   std::vector<Piece>& pieces) {
  const double x = base.x()[knot], width = base.x()[knot + 1] - x;
  const double first = base.cdf(x), last = base.cdf(base.x()[knot + 1]);
  if (!(width > 0.0 && last > first)) return;
  const double f = base.value()[knot], slope = (base.value()[knot + 1] - f) / width;

  const auto t = q.x();
  auto node = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), first) - t.begin()) - 1;
  for (double start = first; start < last; start = t[++node]) {
    const double step = t[node + 1] - t[node], beyond = start - t[node];
    if (!(step > 0.0)) continue;  // a jump
    const double q_slope = (q.value()[node + 1] - q.value()[node]) / step;
    const double sum_slope = (q_sum[node + 1] - q_sum[node]) / step;
    const Way way = way_to(start - first, f, slope);
    pieces.push_back({.u = q.cdf(start),
                      .lambda = x + way.s,
                      .q = (q.value()[node] + q_slope * beyond),
                      .q_slope = (q_slope),
                      .b = (way.density),
                      .b_slope = (slope),
                      .sum = (q_sum[node] + sum_slope * beyond),
                      .sum_slope = (sum_slope)});
  }
}

void ComposedDensities::build_guide(Density& density) {
  const std::size_t size = std::bit_ceil(2 * density.pieces.size());
  density.guide_scale = static_cast<double>(size);
  density.guide.reserve(size + 1);
  std::uint32_t piece = 0;
  for (std::size_t i = 0; i <= size; ++i) {
    while (density.pieces[piece + 1].u <= static_cast<double>(i) / density.guide_scale) ++piece;
    density.guide.push_back(piece);
  }
  density.guide.push_back(static_cast<std::uint32_t>(density.pieces.size()) - 2);
}

const ComposedDensities::Piece* ComposedDensities::Density::find(double v) const {
  // Where a density is next to nothing, one step holds a great many pieces; few paths come there.
  constexpr std::ptrdiff_t kFew = 16;
  const std::uint32_t* step = &guide[static_cast<std::size_t>(v * guide_scale)];
  const Piece *piece = &pieces[step[0]], *last = &pieces[step[1]];
  if (last - piece > kFew)
    piece = std::upper_bound(piece + 1, last + 1, v, [](double u, const Piece& p) { return u < p.u; }) - 1;
  while (piece[1].u <= v) ++piece;
  return piece;
}

void ComposedDensities::draw(double u, std::span<double> lambda, std::span<double> density_sum) const {
  for (std::size_t k = 0; k < densities_.size(); ++k) {
    const double v = densities_[k].backwards ? 1.0 - u : u;
    const Piece* piece = densities_[k].find(v);
    const Way t = way_to(v - piece->u, piece->q, piece->q_slope);
    const Way way = way_to(t.s, piece->b, piece->b_slope);
    lambda[k] = std::min(piece->lambda + way.s, piece[1].lambda);
    density_sum[k] = (piece->sum + piece->sum_slope * t.s) * way.density;
  }
}

}  // namespace photopic
