#include "core/lights/grid_densities.h"

#include <bit>

namespace photopic {
namespace {

/// Adds running sums of weights over their total; where that is 0, equal steps. @return the total
double accumulate(std::span<const double> weights, std::vector<float>& sums) {
  double total = 0.0, sum = 0.0;
  for (const double w : weights) total += w;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double even = static_cast<double>(i) / static_cast<double>(weights.size());
    sums.push_back(static_cast<float>(total > 0.0 ? sum / total : even));
    sum += weights[i];
  }
  sums.push_back(1.0f);
  return total;
}

}  // namespace

std::int32_t GridDensities::add(std::span<const double> weights, std::size_t width) {
  const std::size_t height = weights.size() / width, first = sums_.size();
  std::vector<double> rows(height);
  std::vector<float> columns;
  for (std::size_t y = 0; y < height; ++y) rows[y] = accumulate(weights.subspan(y * width, width), columns);
  accumulate(rows, sums_);
  sums_.insert(sums_.end(), columns.begin(), columns.end());
  const auto step_in = [](std::size_t count) { return static_cast<std::int32_t>(std::bit_ceil(count) / 2); };
  widest_step_ = std::max({widest_step_, step_in(width), step_in(height)});
  return static_cast<std::int32_t>(first);
}

}  // namespace photopic
