#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace photopic {

/// Draws an index in constant time with a probability proportional to its weight: Walker 1977, built as Vose
/// 1991 does.
class AliasTable {
 public:
  AliasTable() = default;
  /// @param weights finite, not negative, their sum above 0; or none
  explicit AliasTable(std::span<const double> weights);

  std::size_t size() const { return bins_.size(); }
  float probability(std::size_t index) const { return bins_[index].probability; }

  /// @param u in [0, 1); becomes a fresh number in [0, 1), with as many digits fewer as the choice took
  std::uint32_t sample(double& u) const { return bins_.size() == 1 ? 0 : sample_bins(u); }

  /// Fetches what sample() will want.
  void prefetch(double u) const {
    __builtin_prefetch(bins_.data() + static_cast<std::size_t>(u * static_cast<double>(bins_.size())));
  }

 private:
  std::uint32_t sample_bins(double& u) const;

  struct Bin {
    double keep = 1.0;  ///< share of the bin that is its own index's
    std::uint32_t alias = 0;
    float probability = 0.0f;
  };
  std::vector<Bin> bins_;
};

}  // namespace photopic
