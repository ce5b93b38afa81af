#pragma once

#include <algorithm>
#include <vector>

#include "spectral/sampled_spectrum.h"

namespace photopic {

/// Knots in ascending order without doubles, cut to the rendered range, whose ends are among them [nm].
inline std::vector<double> knots_in_range(std::vector<double> knots) {
  std::erase_if(knots, [](double x) { return !(x > kLambdaMin && x < kLambdaMax); });
  knots.push_back(kLambdaMin);
  knots.push_back(kLambdaMax);
  std::sort(knots.begin(), knots.end());
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

}  // namespace photopic
