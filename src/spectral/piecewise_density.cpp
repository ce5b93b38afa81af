#include "spectral/piecewise_density.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "spectral/compensated_sum.h"

namespace photopic {
namespace {

void check(const std::vector<double>& x, const std::vector<double>& value) {
  if (x.size() != value.size() || x.size() < 2)
    throw std::invalid_argument("a density needs two knots or more, and a value for each");
  const auto bad_value = [](double v) { return !(std::isfinite(v) && v >= 0.0); };
  if (std::any_of(value.begin(), value.end(), bad_value))
    throw std::invalid_argument("a density's values must be finite and not negative");
  const auto not_finite = [](double v) { return !std::isfinite(v); };
  if (std::any_of(x.begin(), x.end(), not_finite) || !std::is_sorted(x.begin(), x.end()) ||
      x.front() == x.back())
    throw std::invalid_argument("a density's knots must be finite, in order, and not all at one place");
}

double integral(const std::vector<double>& x, const std::vector<double>& value) {
  CompensatedSum sum;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) sum += (x[i + 1] - x[i]) * (0.5 * (value[i] + value[i + 1]));
  return sum.value();
}

}  // namespace

PiecewiseLinearDensity::PiecewiseLinearDensity(std::vector<double> x, std::vector<double> value)
    : x_(std::move(x)), value_(std::move(value)) {
  check(x_, value_);
  normalise();
  build_cells();
  build_guides();
}

void PiecewiseLinearDensity::normalise() {
  const double largest = *std::max_element(value_.begin(), value_.end());
  if (largest == 0.0) throw std::invalid_argument("a density is zero everywhere");
  // What is normalised already stays as it is, to the last bit: a file read back draws the same wavelengths.
  if (std::abs(integral(x_, value_) - 1.0) < 1e-13) return;
  for (double& v : value_) v /= largest;
  const double total = integral(x_, value_);
  if (!(total > 0.0)) throw std::invalid_argument("a density is zero everywhere but at a single place");
  for (double& v : value_) v /= total;
}

void PiecewiseLinearDensity::build_cells() {
  CompensatedSum sum;
  double reached = 0.0;
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
    const double width = x_[i + 1] - x_[i];
    if (width == 0.0) continue;
    cells_.push_back({x_[i], reached, value_[i], (value_[i + 1] - value_[i]) / width});
    const double mass = width * (0.5 * (value_[i] + value_[i + 1]));
    if (mass > 0.0) last_mass_ = cells_.size() - 1;
    sum += mass;
    reached = std::clamp(sum.value(), reached, 1.0);
  }
  for (std::size_t i = last_mass_ + 1; i < cells_.size(); ++i) cells_[i].cdf = 1.0;
  cells_.push_back({x_.back(), 1.0, 0.0, 0.0});
}

void PiecewiseLinearDensity::build_guides() {
  std::vector<double> x_end, u_end;
  for (std::size_t i = 0; i + 1 < cells_.size(); ++i) x_end.push_back(cells_[i + 1].x);
  for (std::size_t i = 0; i <= last_mass_; ++i) u_end.push_back(cells_[i + 1].cdf);
  const auto steps =
      static_cast<double>(std::clamp<std::size_t>(std::bit_ceil(4 * cells_.size()), 64, 1 << 16));
  cell_of_x_ = GuideTable(x_.front(), std::move(x_end), steps / (x_.back() - x_.front()));
  cell_of_u_ = GuideTable(0.0, std::move(u_end), steps);
}

double PiecewiseLinearDensity::density(double x) const {
  if (!(x >= x_.front() && x <= x_.back())) return 0.0;
  const Cell& cell = cells_[cell_of_x_.find(x)];
  return std::max(0.0, cell.f + cell.slope * (x - cell.x));
}

double PiecewiseLinearDensity::cdf(double x) const {
  if (!(x > x_.front())) return 0.0;
  if (x >= x_.back()) return 1.0;
  const std::size_t i = cell_of_x_.find(x);
  const Cell& cell = cells_[i];
  const double s = x - cell.x;
  return std::min(cell.cdf + s * (cell.f + 0.5 * cell.slope * s), cells_[i + 1].cdf);
}

double PiecewiseLinearDensity::inverse(double u) const {
  return draw(u).x;
}

PiecewiseLinearDensity::Draw PiecewiseLinearDensity::draw(double u) const {
  u = std::clamp(u, 0.0, 1.0);
  const Cell* cell = &cells_[cell_of_u_.find(u)];
  const double mass = std::max(0.0, u - cell->cdf);
  // This form of the root neither cancels nor divides by a slope of zero, and the square root itself is the
  // density.
  const double density = std::sqrt(std::max(0.0, cell->f * cell->f + 2.0 * cell->slope * mass));
  const double s = 2.0 * mass / (cell->f + density + std::numeric_limits<double>::min());
  return {std::min(cell->x + s, cell[1].x), density};
}

}  // namespace photopic
