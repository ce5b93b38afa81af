#include "spectral/piecewise_density.h"

#include <algorithm>
#include <bit>
#include <cmath>
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

constexpr std::size_t kScan = 8;  ///< up to so many cells, walking beats halving

/// The last index in [first, last] whose key is at or before `key`, or `first` where none is.
template <typename KeyOf>
std::size_t last_at_or_before(std::size_t first, std::size_t last, double key, KeyOf key_of) {
  while (last - first > kScan) {
    const std::size_t middle = first + (last - first + 1) / 2;
    if (key_of(middle) <= key)
      first = middle;
    else
      last = middle - 1;
  }
  while (first < last && key_of(first + 1) <= key) ++first;
  return first;
}

/// For equal steps of a non-decreasing key from `start`: the cell that last_at_or_before finds there. Entries
/// are early by more than a look-up's rounding, and one is kept beyond the end, so that [entry, entry + 2]
/// always holds the cell.
template <typename KeyOf>
std::vector<std::uint32_t> guide_table(std::size_t size, double start, double step, std::size_t last,
                                       KeyOf key_of) {
  std::vector<std::uint32_t> guide(size + 3, static_cast<std::uint32_t>(last));
  const double early = 1e-14 * (std::abs(start) + static_cast<double>(size) * step);
  std::size_t cell = 0;
  for (std::size_t i = 0; i <= size; ++i) {
    const double key = start + static_cast<double>(i) * step - early;
    while (cell < last && key_of(cell + 1) <= key) ++cell;
    guide[i] = static_cast<std::uint32_t>(cell);
  }
  return guide;
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
  const std::size_t last = cells_.size() - 2;
  const std::size_t size = std::clamp<std::size_t>(std::bit_ceil(8 * cells_.size()), 64, 1 << 16);
  u_scale_ = static_cast<double>(size);
  x_scale_ = static_cast<double>(size) / (x_.back() - x_.front());
  guide_u_ =
      guide_table(size, 0.0, 1.0 / u_scale_, last_mass_, [this](std::size_t i) { return cells_[i].cdf; });
  guide_x_ =
      guide_table(size, x_.front(), 1.0 / x_scale_, last, [this](std::size_t i) { return cells_[i].x; });
}

std::size_t PiecewiseLinearDensity::cell_of_x(double x) const {
  const auto entry = static_cast<std::size_t>((x - x_.front()) * x_scale_);
  return last_at_or_before(guide_x_[entry], guide_x_[entry + 2], x,
                           [this](std::size_t i) { return cells_[i].x; });
}

std::size_t PiecewiseLinearDensity::cell_of_u(double u) const {
  const auto entry = static_cast<std::size_t>(u * u_scale_);
  return last_at_or_before(guide_u_[entry], guide_u_[entry + 2], u,
                           [this](std::size_t i) { return cells_[i].cdf; });
}

double PiecewiseLinearDensity::density(double x) const {
  if (!(x >= x_.front() && x <= x_.back())) return 0.0;
  const Cell& cell = cells_[cell_of_x(x)];
  return std::max(0.0, cell.f + cell.slope * (x - cell.x));
}

double PiecewiseLinearDensity::cdf(double x) const {
  if (!(x > x_.front())) return 0.0;
  if (x >= x_.back()) return 1.0;
  const std::size_t i = cell_of_x(x);
  const Cell& cell = cells_[i];
  const double s = x - cell.x;
  return std::min(cell.cdf + s * (cell.f + 0.5 * cell.slope * s), cells_[i + 1].cdf);
}

double PiecewiseLinearDensity::inverse(double u) const {
  return draw(u).x;
}

PiecewiseLinearDensity::Draw PiecewiseLinearDensity::draw(double u) const {
  const std::size_t i = cell_of_u(std::clamp(u, 0.0, 1.0));
  const Cell& cell = cells_[i];
  // f·s + slope·s²/2 = rest; this form of the root neither cancels nor divides by a slope of zero, and the
  // root itself is the density there.
  const double rest = std::max(0.0, u - cell.cdf);
  const double root = std::sqrt(std::max(0.0, cell.f * cell.f + 2.0 * cell.slope * rest));
  const double sum = cell.f + root;
  const double s = sum > 0.0 ? 2.0 * rest / sum : 0.0;
  return {std::min(cell.x + s, cells_[i + 1].x), root};
}

}  // namespace photopic
