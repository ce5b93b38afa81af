#pragma once

#include <array>

#include "core/lanes.h"
#include "spectral/float_vectors.h"

namespace photopic {

/// Rows of n floats that stand side by side in memory, as many as a vector of 16 holds. Not read from there
/// as one: a wide load waits for the narrow stores before it.
template <std::size_t n, typename RowOf>
PHOTOPIC_INLINE Lanes load_rows(const RowOf& row_of) {
  if constexpr (n == 16) {
    return load<Lanes>(row_of(0));
  } else if constexpr (n == 8) {
    return join(load<Float8>(row_of(0)), load<Float8>(row_of(1)));
  } else if constexpr (n == 4) {
    const auto row = [&](int i) { return load<Float4>(row_of(i)); };
    return join(join(row(0), row(1)), join(row(2), row(3)));
  } else if constexpr (n == 2) {
    const auto row = [&](int i) { return load<double>(row_of(i)); };  // both floats
    return reinterpret_cast<Lanes>(Double8{row(0), row(1), row(2), row(3), row(4), row(5), row(6), row(7)});
  } else {
    static_assert(n == 1);
    Lanes numbers;
    for (int i = 0; i < kLanes; ++i) numbers[i] = load<float>(row_of(i));
    return numbers;
  }
}

/// A row of n floats for each lane, as n columns: read whole and transposed in registers they take a third of
/// the instructions of single numbers. @param row_of gives a lane's address
template <std::size_t n, typename RowOf>
PHOTOPIC_INLINE std::array<Lanes, n> gather_rows(const RowOf& row_of) {
  constexpr int kPerVector = kLanes / static_cast<int>(n);
  std::array<Lanes, n> rows;
  for (std::size_t k = 0; k < n; ++k)
    rows[k] = load_rows<n>([&](int i) { return row_of(static_cast<int>(k) * kPerVector + i); });
  return columns(rows);
}

}  // namespace photopic
