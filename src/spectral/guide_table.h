#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace photopic {

/// Finds the cell that holds a number, as a rule without a search: the range is cut into equal steps, and
/// each step remembers the cell at its beginning (Chen & Asau 1974, "On Generating Random Variates from an
/// Empirical Distribution"; Devroye 1986, III.2.4).
class GuideTable {
 public:
  GuideTable() = default;
  /// @param ends         where each cell ends and the next begins, non-decreasing, not before `begin`; cells
  ///                     may be empty
  /// @param steps_per_unit of the range, which ends with the last cell; the memory of all steps is the
  /// caller's care
  GuideTable(double begin, std::vector<double> ends, double steps_per_unit)
      : begin_(begin), steps_per_unit_(steps_per_unit), ends_(std::move(ends)) {
    last_step_ = (ends_.back() - begin_) * steps_per_unit_;
    ends_.back() = std::numeric_limits<double>::infinity();
    guide_.assign(step_of(ends_.back()) + 2, 0);
    for (std::size_t i = 0; i + 1 < ends_.size(); ++i) ++guide_[step_of(ends_[i]) + 1];
    for (std::size_t i = 1; i < guide_.size(); ++i) guide_[i] += guide_[i - 1];
  }

  /// The first cell that ends beyond x, or the last. @param x not before `begin`
  std::uint32_t find(double x) const {
    const std::size_t step = step_of(x);
    std::uint32_t cell = guide_[step];
    cell += ends_[cell] <= x;
    if (ends_[cell] <= x) [[unlikely]] {
      const auto first = ends_.begin() + cell, last = ends_.begin() + guide_[step + 1];
      cell = static_cast<std::uint32_t>(std::upper_bound(first, last, x) - ends_.begin());
    }
    return cell;
  }

 private:
  /// Non-decreasing in x whatever the rounding, so that an end in an earlier step than x's lies before x.
  std::size_t step_of(double x) const {
    return static_cast<std::uint32_t>(std::min((x - begin_) * steps_per_unit_, last_step_));
  }

  double begin_ = 0, steps_per_unit_ = 0, last_step_ = 0;
  std::vector<double> ends_;          ///< the last one infinite
  std::vector<std::uint32_t> guide_;  ///< for each step, and behind the last: how many cells end earlier
};

}  // namespace photopic
