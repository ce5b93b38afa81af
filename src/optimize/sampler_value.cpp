#include "optimize/sampler_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "optimize/path_estimate.h"
#include "spectral/color_difference.h"
#include "spectral/lamp_set.h"

namespace photopic {
namespace {

/// The estimates of all targets side by side: X, Y, Z one after the other.
struct Estimates {
  std::array<std::vector<double>, 3> of;
  explicit Estimates(std::size_t count) { of.fill(std::vector<double>(count, 0.0)); }
};

/// Reflectances at every nm, side by side; linear in between, which of smooth ones is exact to 1e-4.
class ReflectanceRows {
 public:
  explicit ReflectanceRows(std::span<const Spectrum> reflectances) : count_(reflectances.size()) {
    for (double nm = kLambdaMin; nm <= kLambdaMax + 1.0; nm += 1.0)
      for (const Spectrum& reflectance : reflectances) rows_.push_back(evaluate(reflectance, nm));
  }

  /// What the targets return of a path.
  void see(const PathEstimate& path, Estimates& estimates) const {
    for (auto& channel : estimates.of) std::fill(channel.begin(), channel.end(), 0.0);
    for (std::size_t j = 0; j < path.lambda().size(); ++j) add(path.lambda()[j], path.weight()[j], estimates);
  }

 private:
  void add(double lambda, Xyz weight, Estimates& estimates) const {
    const auto row = static_cast<std::size_t>(lambda - kLambdaMin);
    const double f = lambda - kLambdaMin - static_cast<double>(row);
    const double *left = &rows_[row * count_], *right = left + count_;
    auto& [x, y, z] = estimates.of;
    for (std::size_t m = 0; m < count_; ++m) {
      const double r = left[m] + f * (right[m] - left[m]);
      x[m] += weight.x * r, y[m] += weight.y * r, z[m] += weight.z * r;
    }
  }

  std::size_t count_;
  std::vector<double> rows_;  ///< row by row, and one beyond the end
};

/// The first two moments of all targets' estimates.
class Moments {
 public:
  explicit Moments(std::size_t count) : mean_(count) { square_.fill(std::vector<double>(count, 0.0)); }

  void add(const Estimates& estimates, double share) {
    const auto& [x, y, z] = estimates.of;
    auto& [mx, my, mz] = mean_.of;
    auto& [xx, xy, xz, yy, yz, zz] = square_;
    for (std::size_t m = 0; m < x.size(); ++m) {
      const double sx = share * x[m], sy = share * y[m], sz = share * z[m];
      mx[m] += sx, my[m] += sy, mz[m] += sz;
      xx[m] += sx * x[m], xy[m] += sx * y[m], xz[m] += sx * z[m];
      yy[m] += sy * y[m], yz[m] += sy * z[m], zz[m] += sz * z[m];
    }
  }

  /// sqrt(tr(U Cov Uᵀ)) of one target, with the metric at the mean.
  double deviation(std::size_t m, Xyz white) const {
    const Xyz mean{mean_.of[0][m], mean_.of[1][m], mean_.of[2][m]};
    const auto& [xx, xy, xz, yy, yz, zz] = square_;
    double variance = 0.0;
    for (const Xyz& u : color_metric(mean, white)) {
      const double of_mean = u.x * mean.x + u.y * mean.y + u.z * mean.z;
      variance += u.x * u.x * xx[m] + u.y * u.y * yy[m] + u.z * u.z * zz[m] +
                  2.0 * (u.x * u.y * xy[m] + u.x * u.z * xz[m] + u.y * u.z * yz[m]) - of_mean * of_mean;
    }
    return std::sqrt(std::max(0.0, variance));
  }

 private:
  Estimates mean_;
  std::array<std::vector<double>, 6> square_;  ///< XX, XY, XZ, YY, YZ, ZZ
};

double asymptotic(const WavelengthSampler& sampler, const Targets& targets,
                  const TabulatedSpectrum& emission) {
  const std::size_t count = targets.reflectances.size();
  const ReflectanceRows reflectances(targets.reflectances);
  PathEstimate path(sampler, emission);
  Moments moments(count);
  Estimates estimates(count);
  path.integrate_over_u([&](double share) {
    reflectances.see(path, estimates);
    moments.add(estimates, share);
  });
  const Xyz white = white_of(targets.white, targets.mixed);
  double sum = 0.0;
  for (std::size_t m = 0; m < count; ++m) sum += moments.deviation(m, white);
  return sum / static_cast<double>(count);
}

double mean_delta_e(const WavelengthSampler& sampler, const Targets& targets) {
  const Xyz white = white_of(targets.white, targets.mixed);
  const Lab reference = xyz_to_lab(white_of(White::illuminant, targets.mixed), white);
  PathEstimate path(sampler, targets.mixed);
  double mean = 0.0;
  path.integrate_over_u(
      [&](double share) { mean += share * delta_e_2000(reference, xyz_to_lab(path.white(), white)); });
  return mean;
}

}  // namespace

double sampler_value(const WavelengthSampler& sampler, const Targets& targets) {
  if (targets.objective == Objective::mean_delta_e) return mean_delta_e(sampler, targets);
  const std::vector<double> shares = luminance_shares(targets.emitters);
  double value = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i)
    value += shares[i] * asymptotic(sampler, targets, targets.emitters[i]);
  return value;
}

}  // namespace photopic
