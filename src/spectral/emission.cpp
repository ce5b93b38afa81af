// Emissions as tables: what the renderer and the optimiser integrate.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "spectral/knots.h"
#include "spectral/spectrum.h"

namespace photopic {
namespace {

/// Knots in ascending order; a jump where the two limits differ.
class TableBuilder {
 public:
  void add(double lambda, double from_left, double from_right) {
    append(lambda, from_left);
    if (from_right != from_left) append(lambda, from_right);
  }
  void append(double lambda, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
      throw std::invalid_argument("an emission holds a value that is negative or not finite");
    lambda_.push_back(lambda);
    value_.push_back(value);
  }
  TabulatedSpectrum build() { return {std::move(lambda_), std::move(value_), Beyond::zero}; }

 private:
  std::vector<double> lambda_, value_;
};

void add_every_nm(std::vector<double>& knots) {
  for (double x = kLambdaMin; x <= kLambdaMax; x += 1.0) knots.push_back(x);
}

/// A line as its three knots: computed at a knot, its foot would be zero only to rounding, and a foot of
/// 1e-10 that slopes away over 100 nm holds more power than a line of 1e-9 nm.
Spectrum line_as_table(const Spectrum& spectrum) {
  const auto* line = std::get_if<LineSpectrum>(&spectrum);
  if (!line) return spectrum;
  const double first = line->centre - line->fwhm, last = line->centre + line->fwhm;
  if (!(first < line->centre && line->centre < last))
    throw std::invalid_argument("an emission line must have a width");
  return TabulatedSpectrum({first, line->centre, last}, {0.0, 1.0, 0.0}, Beyond::zero);
}

/// A spectrum's own knots: between two of them it is linear, or, where there are none, smooth.
void add_knots(std::vector<double>& knots, const Spectrum& spectrum) {
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) {
    knots.insert(knots.end(), table->lambda().begin(), table->lambda().end());
  } else if (!std::holds_alternative<ConstantSpectrum>(spectrum)) {
    add_every_nm(knots);
  }
}

double limit_from_left(const Spectrum& spectrum, double lambda) {
  const auto* table = std::get_if<TabulatedSpectrum>(&spectrum);
  return table ? table->limit_from_left(lambda) : evaluate(spectrum, lambda);
}

double limit_from_right(const Spectrum& spectrum, double lambda) {
  const auto* table = std::get_if<TabulatedSpectrum>(&spectrum);
  return table ? table->limit_from_right(lambda) : evaluate(spectrum, lambda);
}

/// The table of a function given by its one-sided limits, on knots that begin and end with the range.
template <typename FromLeft, typename FromRight>
TabulatedSpectrum tabulate(const std::vector<double>& knots, FromLeft from_left, FromRight from_right) {
  TableBuilder table;
  table.append(knots.front(), from_right(knots.front()));
  for (std::size_t i = 1; i + 1 < knots.size(); ++i)
    table.add(knots[i], from_left(knots[i]), from_right(knots[i]));
  table.append(knots.back(), from_left(knots.back()));
  return table.build();
}

void check_emission(const Spectrum& spectrum) {
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) {
    for (double v : table->value())
      if (v < 0.0) throw std::invalid_argument("an emission holds a negative value");
  } else if (const auto* body = std::get_if<BlackbodySpectrum>(&spectrum)) {
    if (!(body->kelvin > 0.0)) throw std::invalid_argument("a blackbody's temperature must be positive");
  }
}

/// A lamp's scale means nothing, but sums and squares of such values would overflow or vanish.
TabulatedSpectrum without_extremes(TabulatedSpectrum table) {
  const double largest = *std::ranges::max_element(table.value());
  if (largest == 0.0 || (largest < 1e100 && largest > 1e-100)) return table;
  std::vector<double> value(table.value().begin(), table.value().end());
  const int exponent = std::ilogb(largest);
  for (double& v : value) v = std::scalbn(v, -exponent);
  return {{table.lambda().begin(), table.lambda().end()}, std::move(value), Beyond::zero};
}

}  // namespace

TabulatedSpectrum tabulate_emission(const Spectrum& emission) {
  check_emission(emission);
  const Spectrum spectrum = line_as_table(emission);
  std::vector<double> knots;
  add_knots(knots, spectrum);
  return without_extremes(tabulate(
      knots_in_range(std::move(knots)), [&](double x) { return limit_from_left(spectrum, x); },
      [&](double x) { return limit_from_right(spectrum, x); }));
}

TabulatedSpectrum mix_emissions(std::span<const TabulatedSpectrum> emissions,
                                std::span<const double> weights) {
  if (emissions.size() != weights.size())
    throw std::invalid_argument("as many weights as emissions are needed");
  std::vector<double> knots;
  for (std::size_t i = 0; i < emissions.size(); ++i) {
    if (!(weights[i] >= 0.0) || !std::isfinite(weights[i]))
      throw std::invalid_argument("an emission's weight is negative or not finite");
    knots.insert(knots.end(), emissions[i].lambda().begin(), emissions[i].lambda().end());
  }
  const auto sum = [&](auto limit) {
    double total = 0.0;
    for (std::size_t i = 0; i < emissions.size(); ++i) total += weights[i] * limit(emissions[i]);
    return total;
  };
  return tabulate(
      knots_in_range(std::move(knots)),
      [&](double x) { return sum([x](const TabulatedSpectrum& e) { return e.limit_from_left(x); }); },
      [&](double x) { return sum([x](const TabulatedSpectrum& e) { return e.limit_from_right(x); }); });
}

TabulatedSpectrum tabulate_product(const Spectrum& first, const Spectrum& second) {
  const Spectrum a = line_as_table(first), b = line_as_table(second);
  std::vector<double> knots;
  add_every_nm(knots);
  add_knots(knots, a);
  add_knots(knots, b);
  return tabulate(
      knots_in_range(std::move(knots)),
      [&](double x) { return limit_from_left(a, x) * limit_from_left(b, x); },
      [&](double x) { return limit_from_right(a, x) * limit_from_right(b, x); });
}

}  // namespace photopic
