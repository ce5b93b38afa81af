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
/// unchanged.
/// @param starts at the coarsest level; there are fewer for many wavelengths, whose evaluations cost more
std::vector<SearchLevel> search_plan(int wavelengths, int starts);

}  // namespace photopic
