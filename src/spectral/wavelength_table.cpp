#include "spectral/wavelength_table.h"

#include <algorithm>
#include <bit>

#include "spectral/knots.h"

namespace photopic {
namespace {

constexpr double kRange = kLambdaMax - kLambdaMin;

/// x̄, ȳ, z̄ over ∫ȳ dλ.
std::array<TabulatedSpectrum, 3> columns_of(const Observer& observer) {
  std::vector<double> nm, x, y, z;
  for (int i = 0; i < Observer::kTableSize; ++i) {
    nm.push_back(kLambdaMin + i);
    const Xyz h = observer(nm.back()) * (1.0 / observer.y_integral());
    x.push_back(h.x), y.push_back(h.y), z.push_back(h.z);
  }
  const auto column = [&](std::vector<double>& value) {
    return TabulatedSpectrum(nm, std::move(value), Beyond::zero);
  };
  return {column(x), column(y), column(z)};
}

/// Where the cells begin, and the end of the last.
std::vector<double> union_of_knots(std::span<const TabulatedSpectrum* const> columns) {
  std::vector<double> knots;
  for (const TabulatedSpectrum* column : columns)
    knots.insert(knots.end(), column->lambda().begin(), column->lambda().end());
  return knots_in_range(std::move(knots));
}

/// A power of two: knots at whole nanometres fall between two steps, where nothing need be compared.
double steps_per_nm(std::size_t cells) {
  const auto wanted = static_cast<std::size_t>(2.0 * static_cast<double>(cells) / kRange) + 1;
  return static_cast<double>(std::clamp<std::size_t>(std::bit_ceil(wanted), 2, 256));
}

}  // namespace

WavelengthTable::Four::Four(std::span<const TabulatedSpectrum* const> columns) {
  const std::vector<double> knots = union_of_knots(columns);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double begin = knots[i], end = knots[i + 1];
    Values values{};
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double first = columns[k]->limit_from_right(begin);
      values.at_begin[k] = static_cast<float>(first);
      values.rise[k] = static_cast<float>(columns[k]->limit_from_left(end) - first);
    }
    cells_.push_back({begin, static_cast<float>(1.0 / (end - begin))});
    values_.push_back(values);
  }
  cell_of_ = GuideTable(kLambdaMin, {knots.begin() + 1, knots.end()}, steps_per_nm(cells_.size()));
}

WavelengthTable::WavelengthTable(const Observer& observer, std::span<const TabulatedSpectrum> emissions) {
  const std::array<TabulatedSpectrum, 3> of_observer = columns_of(observer);
  std::vector<const TabulatedSpectrum*> columns;
  for (const TabulatedSpectrum& column : of_observer) columns.push_back(&column);
  for (const TabulatedSpectrum& column : emissions) columns.push_back(&column);
  for (std::size_t i = 0; i < columns.size(); i += 4)
    fours_.emplace_back(std::span(columns).subspan(i, std::min<std::size_t>(4, columns.size() - i)));
}

}  // namespace photopic
