#pragma once

#include <limits>

#include "spectral/float_vectors.h"

namespace photopic {

/// A linear density f + slope·s, followed until it has gathered a mass: f·s + slope·s²/2 = mass.
/// Numbers are double or Double4.
template <typename Number>
struct Way {
  Number s;
  Number density;  ///< there
};

/// This form of the root neither cancels nor divides by a slope of zero, and the square root itself is the
/// density.
template <typename Number>
Way<Number> way_to(Number mass, Number f, Number slope) {
  const Number density = root(f * f + 2.0 * slope * mass);
  return {2.0 * mass / (f + density + std::numeric_limits<double>::min()), density};
}

}  // namespace photopic
