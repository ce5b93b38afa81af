#include "optimize/sampler_value.h"

#include <algorithm>
#include <cmath>

#include "spectral/color_difference.h"
#include "spectral/lamp_set.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

/// The wavelengths of one path and what a white target's X, Y, Z gain at each.
struct Path {
  std::vector<double> lambda, density_sum;
  std::vector<Xyz> weight;
};

void trace(const WavelengthSampler& sampler, const Emitter& emitter, double u, Path& path) {
  draw_wavelengths(sampler, u, path.lambda, path.density_sum);
  const Observer& observer = Observer::cie1931();
  for (std::size_t j = 0; j < path.lambda.size(); ++j) {
    const double power = emitter.scale * emitter.emission(path.lambda[j]);
    path.weight[j] = power > 0.0 ? observer(path.lambda[j]) * (power / path.density_sum[j]) : Xyz{};
  }
}

/// Calls visit(path, share) at the points of a two-point Gauss–Legendre rule in every smooth piece of u.
template <typename Visit>
void integrate(const WavelengthSampler& sampler, const Emitter& emitter, Visit visit) {
  constexpr int kAtLeast = 1024;
  std::vector<double> ends = breakpoints(sampler, emitter.emission.lambda());
  for (int i = 0; i <= kAtLeast; ++i) ends.push_back(static_cast<double>(i) / kAtLeast);
  std::sort(ends.begin(), ends.end());

  const auto count = static_cast<std::size_t>(wavelength_count(sampler));
  Path path{std::vector<double>(count), std::vector<double>(count), std::vector<Xyz>(count)};
  const double offset = 0.5 / std::sqrt(3.0);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double width = ends[i + 1] - ends[i];
    if (width == 0.0) continue;
    for (const double side : {-offset, offset}) {
      trace(sampler, emitter, ends[i] + width * (0.5 + side), path);
      visit(path, 0.5 * width);
    }
  }
}

/// The first two moments of a target's estimate.
struct Moments {
  Xyz mean;
  double square[3][3] = {};

  void add(Xyz e, double share) {
    mean += e * share;
    const double v[3] = {e.x, e.y, e.z};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) square[a][b] += share * v[a] * v[b];
  }

  /// sqrt(tr(U Cov Uᵀ)) with the metric at the mean.
  double deviation(Xyz white) const {
    const double m[3] = {mean.x, mean.y, mean.z};
    double variance = 0.0;
    for (const Xyz& row : color_metric(mean, white)) {
      const double r[3] = {row.x, row.y, row.z};
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) variance += r[a] * r[b] * (square[a][b] - m[a] * m[b]);
    }
    return std::sqrt(std::max(0.0, variance));
  }
};

double asymptotic(const WavelengthSampler& sampler, const Targets& targets, const Emitter& emitter) {
  std::vector<Moments> moments(targets.reflectances.size());
  integrate(sampler, emitter, [&](const Path& path, double share) {
    for (std::size_t m = 0; m < moments.size(); ++m) {
      Xyz sum;
      for (std::size_t j = 0; j < path.lambda.size(); ++j)
        sum += path.weight[j] * evaluate(targets.reflectances[m], path.lambda[j]);
      moments[m].add(sum, share);
    }
  });
  const Xyz white = white_of(targets);
  double sum = 0.0;
  for (const Moments& m : moments) sum += m.deviation(white);
  return sum / static_cast<double>(moments.size());
}

double mean_delta_e(const WavelengthSampler& sampler, const Targets& targets, const Emitter& emitter) {
  const Xyz lamp = emission_xyz(emitter.emission, Observer::cie1931());
  const Xyz white = white_of(targets);
  const Lab reference = xyz_to_lab(lamp * (1.0 / lamp.y), white);
  double mean = 0.0;
  integrate(sampler, emitter, [&](const Path& path, double share) {
    Xyz sum;
    for (const Xyz& weight : path.weight) sum += weight;
    mean += share * delta_e_2000(reference, xyz_to_lab(sum, white));
  });
  return mean;
}

}  // namespace

double sampler_value(const WavelengthSampler& sampler, const Targets& targets) {
  if (targets.objective == Objective::mean_delta_e)
    return mean_delta_e(sampler, targets, make_emitter(targets.mixed));
  const std::vector<double> shares = luminance_shares(targets.emitters);
  double value = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i)
    value += shares[i] * asymptotic(sampler, targets, make_emitter(targets.emitters[i]));
  return value;
}

}  // namespace photopic
