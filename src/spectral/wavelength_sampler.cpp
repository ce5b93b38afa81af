#include "spectral/wavelength_sampler.h"

#include <algorithm>
#include <cmath>

namespace photopic {
namespace {

constexpr double kRange = kLambdaMax - kLambdaMin;

bool in_range(double lambda) {
  return lambda >= kLambdaMin && lambda <= kLambdaMax;
}

/// u + j/N, wrapped round into [0, 1).
double rotated(double u, int j, int count) {
  const double v = u + static_cast<double>(j) / count;
  return v < 1.0 ? v : v - 1.0;
}

/// The density p(λ) = a·sech²(a(λ − c)) / (tanh at 830 − tanh at 360), its CDF a scaled tanh.
struct VisibleDensity {
  static constexpr double kA = VisibleWavelengths::kSlope, kCentre = VisibleWavelengths::kCentre;
  double first = std::tanh(kA * (kLambdaMin - kCentre));
  double span = std::tanh(kA * (kLambdaMax - kCentre)) - first;

  double cdf(double lambda) const { return (std::tanh(kA * (lambda - kCentre)) - first) / span; }
  double density(double lambda) const { return density_at_tanh(std::tanh(kA * (lambda - kCentre))); }
  double density_at_tanh(double th) const { return kA * (1.0 - th * th) / span; }
};
const VisibleDensity kVisible;

// Each sampler: its draw, its density sum, and the u where one of its wavelengths meets `lambda`.

void draw(const UniformWavelengths& s, double u, std::span<double> lambda, std::span<double> sum) {
  for (int j = 0; j < s.count; ++j) {
    lambda[j] = kLambdaMin + kRange * rotated(u, j, s.count);
    sum[j] = s.count / kRange;
  }
}

double sum_at(const UniformWavelengths& s, double lambda) {
  return in_range(lambda) ? s.count / kRange : 0.0;
}

void draw(const VisibleWavelengths& s, double u, std::span<double> lambda, std::span<double> sum) {
  for (int j = 0; j < s.count; ++j) {
    const double th = kVisible.first + kVisible.span * rotated(u, j, s.count);
    const double atanh = 0.5 * std::log((1.0 + th) / (1.0 - th));
    lambda[j] = std::clamp(VisibleDensity::kCentre + atanh / VisibleDensity::kA, kLambdaMin, kLambdaMax);
    sum[j] = s.count * kVisible.density_at_tanh(th);
  }
}

double sum_at(const VisibleWavelengths& s, double lambda) {
  return in_range(lambda) ? s.count * kVisible.density(lambda) : 0.0;
}

void draw(const IlluminantWavelengths& s, double u, std::span<double> lambda, std::span<double> sum) {
  // Stratum j has the density N·b inside it and none outside, so the N of them add up to N·b.
  for (int j = 0; j < s.count; ++j) {
    const auto drawn = s.base.draw((u + j) / s.count);
    lambda[j] = drawn.x, sum[j] = s.count * drawn.density;
  }
}

double sum_at(const IlluminantWavelengths& s, double lambda) {
  return s.count * s.base.density(lambda);
}

void draw(const OptimizedWavelengths& s, double u, std::span<double> lambda, std::span<double> sum) {
  s.draw(u, lambda, sum);
}

double sum_at(const OptimizedWavelengths& s, double lambda) {
  return s.density_sum(lambda);
}

/// u with rotated(u, j, N) = v, for every j; v = 0 is the wrap itself.
void add_rotations(double v, int count, std::vector<double>& u) {
  for (int j = 0; j < count; ++j)
    u.push_back(v - static_cast<double>(j) / count + (j > v * count ? 1.0 : 0.0));
}

std::vector<double> raw_breakpoints(const UniformWavelengths& s, std::span<const double> knots) {
  std::vector<double> u;
  add_rotations(0.0, s.count, u);
  for (const double lambda : knots) add_rotations((lambda - kLambdaMin) / kRange, s.count, u);
  return u;
}

std::vector<double> raw_breakpoints(const VisibleWavelengths& s, std::span<const double> knots) {
  std::vector<double> u;
  add_rotations(0.0, s.count, u);
  for (const double lambda : knots) add_rotations(kVisible.cdf(lambda), s.count, u);
  return u;
}

std::vector<double> raw_breakpoints(const IlluminantWavelengths& s, std::span<const double> knots) {
  std::vector<double> u;
  for (const auto list : {s.base.x(), knots})
    for (const double lambda : list)
      for (int j = 0; j < s.count; ++j) u.push_back(s.count * s.base.cdf(lambda) - j);
  return u;
}

std::vector<double> raw_breakpoints(const OptimizedWavelengths& s, std::span<const double> knots) {
  return s.breakpoints(knots);
}

std::vector<bool> orientations(const WavelengthDistribution& distribution) {
  std::vector<bool> backwards;
  for (const auto& component : distribution.components) backwards.push_back(component.backwards);
  return backwards;
}

/// Of densities with the same knots.
PiecewiseLinearDensity mean_of(std::span<const PiecewiseLinearDensity> densities) {
  const auto x = densities[0].x();
  std::vector<double> sum(x.size());
  for (const PiecewiseLinearDensity& one : densities)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one.value()[i];
  return {{x.begin(), x.end()}, std::move(sum)};
}

}  // namespace

OptimizedWavelengths::OptimizedWavelengths(const WavelengthDistribution& distribution)
    : base_(distribution.base),
      densities_(densities_on_t(distribution)),
      backwards_(orientations(distribution)),
      mean_(mean_of(densities_)) {}

void OptimizedWavelengths::draw(double u, std::span<double> lambda, std::span<double> density_sum) const {
  for (std::size_t k = 0; k < densities_.size(); ++k) {
    const double t = densities_[k].inverse(backwards_[k] ? 1.0 - u : u);
    const auto drawn = base_.draw(t);
    lambda[k] = drawn.x, density_sum[k] = count() * mean_.density(t) * drawn.density;
  }
}

double OptimizedWavelengths::density_sum(double lambda) const {
  return count() * mean_.density(base_.cdf(lambda)) * base_.density(lambda);
}

std::vector<double> OptimizedWavelengths::breakpoints(std::span<const double> knots) const {
  std::vector<double> t(densities_[0].x().begin(), densities_[0].x().end());
  for (const auto list : {base_.x(), knots})
    for (const double lambda : list) t.push_back(base_.cdf(lambda));
  std::vector<double> u;
  for (std::size_t k = 0; k < densities_.size(); ++k)
    for (const double at : t)
      u.push_back(backwards_[k] ? 1.0 - densities_[k].cdf(at) : densities_[k].cdf(at));
  return u;
}

std::array<WavelengthSampler, 3> baseline_samplers(int count, const TabulatedSpectrum& light) {
  return {UniformWavelengths{count}, VisibleWavelengths{count},
          IlluminantWavelengths{count, base_density(light)}};
}

int wavelength_count(const WavelengthSampler& sampler) {
  const auto count = [](const auto& s) {
    if constexpr (requires { s.count(); })
      return s.count();
    else
      return s.count;
  };
  return std::visit(count, sampler);
}

std::string_view sampler_name(const WavelengthSampler& sampler) {
  struct Name {
    std::string_view operator()(const UniformWavelengths&) const { return "uniform"; }
    std::string_view operator()(const VisibleWavelengths&) const { return "visible"; }
    std::string_view operator()(const IlluminantWavelengths&) const { return "illuminant"; }
    std::string_view operator()(const OptimizedWavelengths&) const { return "optimized"; }
  };
  return std::visit(Name{}, sampler);
}

void draw_wavelengths(const WavelengthSampler& sampler, double u, std::span<double> lambda,
                      std::span<double> density_sum) {
  std::visit([&](const auto& s) { draw(s, u, lambda, density_sum); }, sampler);
}

double density_sum(const WavelengthSampler& sampler, double lambda) {
  return std::visit([&](const auto& s) { return sum_at(s, lambda); }, sampler);
}

std::vector<double> breakpoints(const WavelengthSampler& sampler, std::span<const double> knots) {
  std::vector<double> u = std::visit([&](const auto& s) { return raw_breakpoints(s, knots); }, sampler);
  std::erase_if(u, [](double v) { return !(v > 0.0 && v < 1.0); });
  std::sort(u.begin(), u.end());
  u.erase(std::unique(u.begin(), u.end()), u.end());
  return u;
}

}  // namespace photopic
