#include "optimize/sampler_report.h"

#include <cmath>

#include "optimize/path_estimate.h"
#include "optimize/random.h"
#include "optimize/reflectance_set.h"
#include "spectral/color_difference.h"

namespace photopic {
namespace {

constexpr int kMeans = 512, kPaths = 64, kReflectances = 24;
constexpr std::uint64_t kSeed = 64;

/// A colour to be met, and the mean of some paths that tries to.
struct Target {
  Spectrum reflectance;
  Lab reference;
  Xyz mean = {};
  double sum_of_delta_e = 0.0;
};

std::vector<Target> make_targets(const PathEstimate& path, Xyz white) {
  std::vector<Target> targets;
  const auto add = [&](const Spectrum& reflectance) {
    targets.push_back({reflectance, xyz_to_lab(path.expected(reflectance), white)});
  };
  add(ConstantSpectrum{1.0});
  for (const Spectrum& reflectance : test_reflectances(kReflectances)) add(reflectance);
  return targets;
}

void measure_one_path(PathEstimate& path, const Lab& reference, Xyz white, SamplerReport& report) {
  double variance = 0.0;
  path.integrate_over_u([&](double share) {
    const Xyz estimate = path.white();
    report.one_path_delta_e += share * delta_e_2000(reference, xyz_to_lab(estimate, white));
    variance += share * (estimate.y - 1.0) * (estimate.y - 1.0);
  });
  report.luminance_deviation = std::sqrt(variance);
}

/// Means of independent paths, as in a pixel.
void measure_many_paths(PathEstimate& path, std::span<Target> targets, Xyz white) {
  Random random(kSeed);
  for (int i = 0; i < kMeans; ++i) {
    for (Target& target : targets) target.mean = {};
    for (int n = 0; n < kPaths; ++n) {
      path.draw(uniform(random));
      for (Target& target : targets) target.mean += path.seen(target.reflectance) * (1.0 / kPaths);
    }
    for (Target& target : targets)
      target.sum_of_delta_e += delta_e_2000(target.reference, xyz_to_lab(target.mean, white));
  }
}

}  // namespace

SamplerReport sampler_report(const WavelengthSampler& sampler, const TabulatedSpectrum& light, White white) {
  PathEstimate path(sampler, light);
  const Xyz lab_white = white_of(white, light);
  std::vector<Target> targets = make_targets(path, lab_white);

  SamplerReport report;
  measure_one_path(path, targets[0].reference, lab_white, report);
  measure_many_paths(path, targets, lab_white);
  report.white_delta_e = targets[0].sum_of_delta_e / kMeans;
  for (std::size_t i = 1; i < targets.size(); ++i)
    report.reflectances_delta_e += targets[i].sum_of_delta_e / (kMeans * kReflectances);
  return report;
}

}  // namespace photopic
