#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/lanes.h"
#include "core/sample_sequence.h"

namespace photopic {

/// Densities over the cells of many grids, all in one array, so that sixteen paths can look up a grid each. A
/// row is drawn, then a cell in it: stratified numbers stay stratified.
class GridDensities {
 public:
  /// One grid, or one in each lane. I: std::int32_t or IntLanes.
  template <typename I>
  struct Grid {
    I first;  ///< of its numbers
    I width, height;
  };

  /// @param weights of the cells, row by row: finite, not negative; where there is none at all, all are alike
  /// @return the number of its first number
  std::int32_t add(std::span<const double> weights, std::size_t width);

  /// How many numbers a grid has.
  static constexpr std::int32_t size_of(std::int32_t width, std::int32_t height) {
    return height + 1 + height * (width + 1);
  }

  // T: float or Lanes.

  template <typename T>
  struct Sample {
    IndexOf<T> x, y;
    T probability;          ///< of the cell
    BasicSample2d<T> part;  ///< where in it, uniform in [0, 1)²
  };
  /// @param u in [0, 1)²
  template <typename T>
  PHOTOPIC_INLINE Sample<T> sample(const Grid<IndexOf<T>>& grid, BasicSample2d<T> u) const {
    const Interval<T> y = find_interval(grid.first, grid.height, u.y);
    const Interval<T> x = find_interval(columns_of(grid, y.index), grid.width, u.x);
    return {x.index, y.index, x.probability * y.probability, {x.part, y.part}};
  }

  /// Of sample()'s cells.
  template <typename T>
  PHOTOPIC_INLINE T probability(const Grid<IndexOf<T>>& grid, IndexOf<T> x, IndexOf<T> y) const {
    const IndexOf<T> column = columns_of(grid, y) + x, row = grid.first + y;
    const float* sums = sums_.data();
    return (gather(sums, column + 1) - gather(sums, column)) * (gather(sums, row + 1) - gather(sums, row));
  }

 private:
  template <typename I>
  static I columns_of(const Grid<I>& grid, I y) {
    return grid.first + grid.height + 1 + y * (grid.width + 1);
  }

  /// The interval of cumulative probabilities that u lies in, none of which is empty.
  template <typename T>
  struct Interval {
    IndexOf<T> index;
    T part;         ///< where in it, [0, 1)
    T probability;  ///< its own
  };
  template <typename T>
  PHOTOPIC_INLINE Interval<T> find_interval(IndexOf<T> first, IndexOf<T> count, T u) const {
    const float* sums = sums_.data();
    IndexOf<T> i{};
    for (std::int32_t step = widest_step_; step > 0; step /= 2) {
      const IndexOf<T> next = select(i + step < count, i + step, count);  // the sum there is 1: above u
      i = select(gather(sums, first + next) <= u, next, i);
    }
    const T low = gather(sums, first + i), probability = gather(sums, first + i + 1) - low;
    return {i, min((u - low) / probability, T{} + kBelowOne), probability};
  }

  static constexpr float kBelowOne = 0x1.fffffep-1f;

  /// Of each grid: the cumulative probabilities of its rows, from 0 to 1, then those of the cells in each
  /// row.
  std::vector<float> sums_;
  std::int32_t widest_step_ = 0;  ///< of a search by halves: a power of 2
};

}  // namespace photopic
