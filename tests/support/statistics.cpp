#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace photopic::test {
namespace {

double gamma_p_series(double a, double x) {
  double term = 1.0 / a, sum = term;
  for (int n = 1; n < 10000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

double gamma_q_fraction(double a, double x) {
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a, c = 1.0 / kTiny, d = 1.0 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = an * d + b;
    if (std::abs(d) < kTiny) d = kTiny;
    c = b + an / c;
    if (std::abs(c) < kTiny) c = kTiny;
    d = 1.0 / d;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return h * std::exp(a * std::log(x) - x - std::lgamma(a));
}

}  // namespace

double chi_square_tail(double x, double degrees_of_freedom) {
  const double a = 0.5 * degrees_of_freedom;
  x *= 0.5;
  if (x <= 0.0) return 1.0;
  return x < a + 1.0 ? 1.0 - gamma_p_series(a, x) : gamma_q_fraction(a, x);
}

double chi_square_p_value(std::span<const double> observed, std::span<const double> expected) {
  constexpr double kFewest = 5.0;
  std::vector<std::size_t> order(observed.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return expected[a] < expected[b]; });

  double statistic = 0.0, pooled_observed = 0.0, pooled_expected = 0.0;
  int cells = 0;
  const auto add = [&](double o, double e) { statistic += (o - e) * (o - e) / e, ++cells; };
  for (const std::size_t i : order) {
    if (expected[i] >= kFewest && (pooled_expected == 0.0 || pooled_expected >= kFewest)) {
      add(observed[i], expected[i]);
      continue;
    }
    pooled_observed += observed[i], pooled_expected += expected[i];
  }
  if (pooled_expected > 0.0) add(pooled_observed, pooled_expected);
  if (pooled_expected < 1e-6 && pooled_observed > 0.0) return 0.0;
  return cells < 2 ? 1.0 : chi_square_tail(statistic, cells - 1);
}

double sidak_significance(double family, std::size_t tests) {
  return -std::expm1(std::log1p(-family) / static_cast<double>(tests));
}

double normal_threshold(double significance) {
  double low = 0.0, high = 40.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > significance ? low : high) = middle;
  }
  return low;
}

double z_score(Estimate a, Estimate b) {
  const double difference = a.mean - b.mean, error = std::hypot(a.error, b.error);
  if (difference == 0.0) return 0.0;
  return error > 0.0 ? difference / error
                     : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

std::vector<Estimate> block_estimates(const Film& film, int x0, int y0, int x1, int y1) {
  Xyz mean, variance;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const auto pixel = static_cast<std::size_t>(y * film.width() + x);
      mean += film.mean(pixel);
      variance += film.variance_of_mean(pixel);
    }
  const double n = static_cast<double>((x1 - x0) * (y1 - y0));
  return {{mean.x / n, std::sqrt(variance.x) / n},
          {mean.y / n, std::sqrt(variance.y) / n},
          {mean.z / n, std::sqrt(variance.z) / n}};
}

std::vector<Estimate> image_estimates(const Film& film) {
  return block_estimates(film, 0, 0, film.width(), film.height());
}

std::vector<Estimate> quarter_estimates(const Film& film) {
  std::vector<Estimate> all = image_estimates(film);
  const int w = film.width(), h = film.height();
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      const auto block = block_estimates(film, x * w / 2, y * h / 2, (x + 1) * w / 2, (y + 1) * h / 2);
      all.insert(all.end(), block.begin(), block.end());
    }
  return all;
}

double largest_z(std::span<const Estimate> a, std::span<const Estimate> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(z_score(a[i], b[i])));
  return largest;
}

Estimate RunningMean::estimate() const {
  const double mean = sum_ / count_;
  const double variance = std::max(0.0, (squares_ - sum_ * mean) / (count_ - 1.0));
  return {mean, std::sqrt(variance / count_)};
}

}  // namespace photopic::test
