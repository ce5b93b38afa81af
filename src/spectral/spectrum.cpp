#include "spectral/spectrum.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "spectral/content_hash.h"

namespace photopic {
namespace {

void check_table(const std::vector<double>& lambda, const std::vector<double>& value) {
  if (lambda.empty() || lambda.size() != value.size())
    throw std::invalid_argument("a tabulated spectrum needs as many values as wavelengths, at least one");
  for (std::size_t i = 0; i < lambda.size(); ++i) {
    if (!std::isfinite(lambda[i]) || !std::isfinite(value[i]))
      throw std::invalid_argument("a tabulated spectrum holds a number that is not finite");
    if (i >= 1 && lambda[i] < lambda[i - 1])
      throw std::invalid_argument("a tabulated spectrum's wavelengths must not decrease");
    if (i >= 2 && lambda[i] == lambda[i - 2])
      throw std::invalid_argument("a tabulated spectrum has more than two values at one wavelength");
  }
}

double blackbody(double kelvin, double lambda) {
  if (!(lambda > 0.0)) return std::isnan(lambda) ? lambda : 0.0;
  constexpr double kC2 = 6.62607015e-34 * 299792458.0 / 1.380649e-23;  // hc/k [m K]
  constexpr double kReference = 560.0;
  const double x = kC2 / (lambda * 1e-9 * kelvin), x0 = kC2 / (kReference * 1e-9 * kelvin);
  // (e^x0 − 1)/(e^x − 1) with the growing exponentials taken out: neither overflows on its own.
  return std::pow(kReference / lambda, 5) * std::exp(x0 - x) * (std::expm1(-x0) / std::expm1(-x));
}

}  // namespace

TabulatedSpectrum::TabulatedSpectrum(std::vector<double> lambda, std::vector<double> value, Beyond beyond)
    : lambda_(std::move(lambda)), value_(std::move(value)), beyond_(beyond) {
  check_table(lambda_, value_);
  const double range = lambda_.back() - lambda_.front();
  if (!(range > 0.0)) return;
  const std::size_t steps = std::min<std::size_t>(lambda_.size() - 1, std::size_t{1} << 24);
  const double steps_per_nm = static_cast<double>(steps) / range;
  cell_of_ = GuideTable(lambda_.front(), {lambda_.begin() + 1, lambda_.end()},
                        std::isfinite(steps_per_nm) ? steps_per_nm : 0.0);
}

double TabulatedSpectrum::operator()(double lambda) const {
  if (!(lambda >= lambda_.front())) return std::isnan(lambda) ? lambda : outside(value_.front());
  if (lambda >= lambda_.back()) return lambda > lambda_.back() ? outside(value_.back()) : value_.back();
  const std::size_t left = cell_of_.find(lambda), right = left + 1;
  const double f = (lambda - lambda_[left]) / (lambda_[right] - lambda_[left]);
  return value_[left] * (1.0 - f) + value_[right] * f;
}

double TabulatedSpectrum::limit_from_left(double lambda) const {
  const auto knot = std::lower_bound(lambda_.begin(), lambda_.end(), lambda);
  if (knot == lambda_.end() || *knot != lambda) return (*this)(lambda);
  return knot == lambda_.begin() ? outside(value_.front()) : value_[knot - lambda_.begin()];
}

double TabulatedSpectrum::limit_from_right(double lambda) const {
  return lambda == lambda_.back() ? outside(value_.back()) : (*this)(lambda);
}

TabulatedSpectrum TabulatedSpectrum::scaled(double factor) const {
  std::vector<double> value = value_;
  for (double& v : value) v *= factor;
  return {lambda_, std::move(value), beyond_};
}

double evaluate(const Spectrum& spectrum, double lambda) {
  struct Visitor {
    double lambda;
    double operator()(const ConstantSpectrum& s) const { return s.value; }
    double operator()(const TabulatedSpectrum& s) const { return s(lambda); }
    double operator()(const BlackbodySpectrum& s) const { return blackbody(s.kelvin, lambda); }
    double operator()(const LineSpectrum& s) const {
      const double value = 1.0 - std::abs(lambda - s.centre) / s.fwhm;
      return value < 0.0 ? 0.0 : value;
    }
    double operator()(const SigmoidPolynomial& s) const { return s(lambda); }
  };
  return std::visit(Visitor{lambda}, spectrum);
}

std::string digest(const TabulatedSpectrum& spectrum) {
  double largest = 0.0;
  for (double v : spectrum.value()) largest = std::max(largest, std::abs(v));
  if (largest == 0.0) largest = 1.0;

  ContentHash hash;
  for (std::size_t i = 0; i < spectrum.lambda().size(); ++i) {
    hash.add(std::clamp(spectrum.lambda()[i], -1e9, 1e9), 1e-6);
    hash.add(spectrum.value()[i] / largest, 1e-7);
  }
  return hash.text();
}

}  // namespace photopic
