#include "spectral/composed_densities.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "spectral/linear_density.h"

namespace photopic {

ComposedDensities::ComposedDensities(const PiecewiseLinearDensity& base,
                                     std::span<const PiecewiseLinearDensity> q,
                                     const std::vector<bool>& backwards) {
  std::vector<double> q_sum(q.front().value().size());
  for (const PiecewiseLinearDensity& one : q)
    for (std::size_t i = 0; i < q_sum.size(); ++i) q_sum[i] += one.value()[i];

  for (std::size_t k = 0; k < q.size(); ++k) {
    Density density{.pieces = {}, .backwards = backwards[k]};
    for (std::size_t i = 0; i + 1 < base.x().size(); ++i) add_pieces(base, i, q[k], q_sum, density.pieces);
    density.pieces.push_back({.u = std::numeric_limits<double>::infinity(), .lambda = base.x().back()});
    densities_.push_back(std::move(density));
  }
  build_guide();
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
    const auto way = way_to(start - first, f, slope);
    pieces.push_back({.u = q.cdf(start),
                      .lambda = x + way.s,
                      .q = q.value()[node] + q_slope * beyond,
                      .q_slope = q_slope,
                      .b = way.density,
                      .b_slope = slope,
                      .sum = q_sum[node] + sum_slope * beyond,
                      .sum_slope = sum_slope});
  }
}

/// The piece that holds v: the last that begins there or before.
std::uint32_t ComposedDensities::Density::piece_at(double v) const {
  const auto next = std::ranges::upper_bound(pieces, v, {}, &Piece::u);
  return static_cast<std::uint32_t>(next == pieces.begin() ? 0 : next - pieces.begin() - 1);
}

void ComposedDensities::build_guide() {
  std::size_t most = 0;
  for (const Density& density : densities_) most = std::max(most, density.pieces.size());
  steps_ = static_cast<double>(std::bit_ceil(2 * most));
  for (double step = 0.0; step < steps_; ++step)
    for (const Density& density : densities_)
      guide_.push_back(density.piece_at(density.backwards ? 1.0 - (step + 1.0) / steps_ : step / steps_));
}

const ComposedDensities::Piece* ComposedDensities::piece_at(std::size_t k, double v,
                                                            const std::uint32_t* guide) const {
  const Piece* piece = &densities_[k].pieces[guide[k]];
  piece += piece[1].u <= v;
  if (piece[1].u <= v) [[unlikely]]
    piece = &densities_[k].pieces[densities_[k].piece_at(v)];
  return piece;
}

void ComposedDensities::draw(double u, std::span<double> lambda, std::span<double> density_sum) const {
  const auto step = static_cast<std::size_t>(std::min(u * steps_, steps_ - 1.0));
  const std::uint32_t* guide = &guide_[step * densities_.size()];
  const auto driven_by = [this, u](std::size_t k) { return densities_[k].driven_by(u); };
  const auto piece_at = [this, guide](std::size_t k, double v) { return this->piece_at(k, v, guide); };
  std::size_t k = 0;
  for (; k + 4 <= densities_.size(); k += 4) {
    const Double4 v{driven_by(k), driven_by(k + 1), driven_by(k + 2), driven_by(k + 3)};
    const Piece *p0 = piece_at(k, v[0]), *p1 = piece_at(k + 1, v[1]), *p2 = piece_at(k + 2, v[2]),
                *p3 = piece_at(k + 3, v[3]);
    auto begin = load<Double4>(&p0->u), start = load<Double4>(&p1->u), q = load<Double4>(&p2->u),
         q_slope = load<Double4>(&p3->u);
    transpose(begin, start, q, q_slope);
    auto b = load<Double4>(&p0->b), b_slope = load<Double4>(&p1->b), sum = load<Double4>(&p2->b),
         sum_slope = load<Double4>(&p3->b);
    transpose(b, b_slope, sum, sum_slope);
    const Double4 end{p0[1].lambda, p1[1].lambda, p2[1].lambda, p3[1].lambda};
    const auto t = way_to(v - begin, q, q_slope);
    const auto way = way_to(t.s, b, b_slope);
    const Double4 reached = start + way.s;
    store(&lambda[k], reached < end ? reached : end);
    store(&density_sum[k], (sum + sum_slope * t.s) * way.density);
  }
  for (; k < densities_.size(); ++k) {
    const double v = driven_by(k);
    const Piece* piece = piece_at(k, v);
    const auto t = way_to(v - piece->u, piece->q, piece->q_slope);
    const auto way = way_to(t.s, piece->b, piece->b_slope);
    lambda[k] = std::min(piece->lambda + way.s, piece[1].lambda);
    density_sum[k] = (piece->sum + piece->sum_slope * t.s) * way.density;
  }
}

}  // namespace photopic
