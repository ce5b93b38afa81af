#pragma once

#include "core/lanes.h"

namespace photopic {

/// A place between two entries of a table with equal steps, or one in each lane.
template <typename T>
struct BasicTablePosition {
  decltype(to_int(T{})) cell;
  T t;  ///< in [0, 1] from this entry to the next
  T weight(int end) const { return end == 0 ? 1.0f - t : t; }
};
using TablePosition = BasicTablePosition<float>;

/// @param x in [0, 1], clamped; NaN is 0 @param size number of entries, at least 2
template <typename T>
BasicTablePosition<T> locate(T x, int size) {
  const T scaled = min(max(T{}, x), T{} + 1.0f) * static_cast<float>(size - 1);
  const auto below = to_int(scaled);
  const auto cell = below - (below == size - 1 ? 1 : 0);
  return {cell, scaled - to_float(cell)};
}

}  // namespace photopic
