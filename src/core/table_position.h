#pragma once

#include <algorithm>

namespace photopic {

/// A place between two entries of a table with equal steps.
struct TablePosition {
  int cell;
  float t;  ///< in [0, 1] from this entry to the next
  float weight(int end) const { return end == 0 ? 1.0f - t : t; }
};

/// @param x in [0, 1], clamped @param size number of entries, at least 2
inline TablePosition locate(float x, int size) {
  const float scaled = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(size - 1);
  const int cell = std::min(static_cast<int>(scaled), size - 2);
  return {cell, scaled - static_cast<float>(cell)};
}

}  // namespace photopic
