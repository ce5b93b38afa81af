#pragma once

#include <random>
#include <vector>

namespace photopic {

/// A point of the search: N densities by the logarithms of their node values, with orientations.
struct Candidate {
  std::vector<bool> backwards;
  std::vector<double> v;  ///< node by node, density by density
  double value = 0.0;     ///< of the objective [ΔE]

  int wavelengths() const { return static_cast<int>(backwards.size()); }
  int nodes() const { return static_cast<int>(v.size() / backwards.size()); }
};

using Random = std::mt19937_64;

/// N soft strata between the given boundaries t_0 = 0 < t_1 < … < t_N = 1.
Candidate soft_strata(const std::vector<double>& boundaries, std::vector<bool> backwards, int nodes);

/// N equal strata of t with edges one cell wide: the illuminant sampler, as nearly as nodes can say it.
Candidate equal_strata(int wavelengths, int nodes);

/// Soft strata between random boundaries, randomly oriented.
Candidate random_candidate(int wavelengths, int nodes, Random& random);

/// The same densities on another number of nodes, linear in between: unchanged where each cell is halved.
Candidate resampled(const Candidate& candidate, int nodes);

}  // namespace photopic
