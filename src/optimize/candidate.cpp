#include "optimize/candidate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace photopic {
namespace {

/// log of a density that is flat between two boundaries and falls off outside.
double soft_box(double t, double left, double right) {
  constexpr double kFall = 30.0, kLowest = -10.0;
  return std::max(kLowest, -kFall * std::max({0.0, left - t, t - right}));
}

/// N soft strata between the boundaries t_0 = 0 < t_1 < … < t_N = 1.
Candidate soft_strata(const std::vector<double>& boundaries, std::vector<bool> backwards, int nodes) {
  Candidate candidate{std::move(backwards), {}};
  for (int k = 0; k < candidate.wavelengths(); ++k)
    for (int b = 0; b < nodes; ++b)
      candidate.v.push_back(soft_box(static_cast<double>(b) / (nodes - 1), boundaries[k], boundaries[k + 1]));
  return candidate;
}

}  // namespace

Candidate equal_strata(int wavelengths, int least_nodes) {
  // Whole cells for each stratum, so that all have the same shape, and half of one at either end for the
  // ramps.
  const int per_stratum = (least_nodes - 2 + wavelengths - 1) / wavelengths;
  const int nodes = per_stratum * wavelengths + 2;
  // Outside its stratum a density must be next to nothing: a wavelength gone astray leaves a hole in its own.
  // The very ends belong to the outer strata.
  const auto floor_of = [&](int k, int b) {
    const bool at_end = (k == 0 && b == 0) || (k == wavelengths - 1 && b == nodes - 1);
    return at_end ? 1.0 : 1e-7;
  };
  Candidate candidate{std::vector<bool>(wavelengths, false), {}};
  for (int k = 0; k < wavelengths; ++k)
    for (int b = 0; b < nodes; ++b) {
      const double from_left = b - (k * per_stratum + 0.5), from_right = (k + 1) * per_stratum + 0.5 - b;
      candidate.v.push_back(std::log(std::clamp(0.5 + std::min(from_left, from_right), floor_of(k, b), 1.0)));
    }
  return candidate;
}

Candidate random_candidate(int wavelengths, int nodes, Random& random) {
  // Widths of strata as a Dirichlet distribution spreads them, half way to equal ones.
  std::vector<double> boundaries{0.0};
  for (int k = 0; k < wavelengths; ++k)
    boundaries.push_back(boundaries.back() + 0.5 - std::log(1.0 - uniform(random)));
  for (double& t : boundaries) t /= boundaries.back();
  boundaries.back() = 1.0;
  std::vector<bool> backwards;
  for (int k = 0; k < wavelengths; ++k) backwards.push_back(uniform(random) < 0.5);
  return soft_strata(boundaries, std::move(backwards), nodes);
}

Candidate resampled(const Candidate& candidate, int nodes) {
  const int from = candidate.nodes();
  Candidate result{candidate.backwards, {}, candidate.value};
  for (int k = 0; k < candidate.wavelengths(); ++k) {
    const double* v = &candidate.v[k * from];
    for (int b = 0; b < nodes; ++b) {
      const double x = static_cast<double>(b) * (from - 1) / (nodes - 1);
      const int i = std::min(static_cast<int>(x), from - 2);
      result.v.push_back(std::log((1.0 - (x - i)) * std::exp(v[i]) + (x - i) * std::exp(v[i + 1])));
    }
  }
  return result;
}

}  // namespace photopic
