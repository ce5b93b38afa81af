#pragma once

#include <vector>

#include "optimize/random.h"

namespace photopic {

/// A point of the search: N densities by the logarithms of their node values, with orientations.
struct Candidate {
  std::vector<bool> backwards;
  std::vector<double> v;  ///< node by node, density by density
  double value = 0.0;     ///< of the objective [ΔE]

  int wavelengths() const { return static_cast<int>(backwards.size()); }
  int nodes() const { return static_cast<int>(v.size() / backwards.size()); }
};

/// N equal strata of t with edges one cell wide: the illuminant sampler, as nearly as nodes can say it. It
/// has `least_nodes` or some more.
Candidate equal_strata(int wavelengths, int least_nodes);

/// Soft strata between random boundaries, randomly oriented.
Candidate random_candidate(int wavelengths, int nodes, Random& random);

/// The same densities on another number of nodes, linear in between: unchanged where each cell is halved.
Candidate resampled(const Candidate& candidate, int nodes);

}  // namespace photopic
