#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "spectral/compensated_sum.h"
#include "spectral/knots.h"
#include "spectral/observer.h"
#include "spectral/wavelength_distribution.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {
namespace {

/// A positive mix of the colour matching functions: where the eye sees, with weight on what it sees as
/// colour. The factors did well among those that were tried; no theory gives them.
double visibility(const Observer& observer, double lambda) {
  const Xyz h = observer(lambda);
  return 0.6 * h.x + 1.0 * h.y + 0.35 * h.z;
}

/// As VisibleWavelengths, unnormalised.
double sech_squared(double lambda) {
  const double cosh = std::cosh(VisibleWavelengths::kSlope * (lambda - VisibleWavelengths::kCentre));
  return 1.0 / (cosh * cosh);
}

/// Mixes a share of another function, normalised over the knots, into a normalised one.
template <typename Function>
void mix_in(double share, Function function, const std::vector<double>& x, std::vector<double>& value) {
  CompensatedSum total;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    total += (x[i + 1] - x[i]) * (0.5 * (function(x[i]) + function(x[i + 1])));
  for (std::size_t i = 0; i < x.size(); ++i)
    value[i] = (1.0 - share) * value[i] + share * function(x[i]) / total.value();
}

/// The knots at which both the emission and the observer are linear in between, cut to the rendered range.
std::vector<double> union_of_knots(const TabulatedSpectrum& emission) {
  std::vector<double> knots(emission.lambda().begin(), emission.lambda().end());
  for (int i = 0; i < Observer::kTableSize; ++i) knots.push_back(kLambdaMin + i);
  return knots_in_range(std::move(knots));
}

}  // namespace

PiecewiseLinearDensity base_density(const TabulatedSpectrum& emission, double defensive, double visible) {
  const auto is_share = [](double share) { return share >= 0.0 && share <= 1.0; };
  if (!is_share(defensive) || !is_share(visible)) throw std::invalid_argument("a share lies in [0, 1]");
  const auto values = emission.value();
  const double brightest = *std::max_element(values.begin(), values.end());
  if (!(brightest > 0.0)) throw std::invalid_argument("the emission is zero everywhere");

  // I·c at both ends of every piece; a jump gives two knots at one place.
  const std::vector<double> knots = union_of_knots(emission);
  const Observer& observer = Observer::cie1931();
  std::vector<double> x, value;
  CompensatedSum total;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double left = knots[i], right = knots[i + 1];
    const double from = emission.limit_from_right(left) / brightest * visibility(observer, left);
    const double to = emission.limit_from_left(right) / brightest * visibility(observer, right);
    if (x.empty() || value.back() != from) x.push_back(left), value.push_back(from);
    x.push_back(right), value.push_back(to);
    total += (right - left) * (0.5 * (from + to));
  }
  if (!(total.value() > 0.0)) throw std::invalid_argument("the emission is zero from 360 to 830 nm");

  for (double& v : value) v /= total.value();
  mix_in(
      defensive, [](double) { return 1.0; }, x, value);
  mix_in(visible, sech_squared, x, value);
  return {std::move(x), std::move(value)};
}

}  // namespace photopic
