#pragma once

#include <vector>

namespace photopic {

/// One level of the search: the best candidates of the level before, on finer densities and more strata of u.
struct SearchLevel {
  int candidates;    ///< that are improved here
  int nodes;         ///< of each density
  int strata;        ///< of u
  int evaluations;   ///< at most, for each candidate
  double tolerance;  ///< relative change of the objective at which a descent ends
};

/// Coarse to fine. The cells of one level halve those of the level before, so that a candidate is handed on
/// unchanged (but to the last level, where another number of nodes is asked for).
/// @param starts at the coarsest level; there are fewer for many wavelengths, whose evaluations cost more
/// @param nodes of the finest level, ≥ 3; 0: 193
std::vector<SearchLevel> search_plan(int wavelengths, int starts, int nodes = 0);

}  // namespace photopic
