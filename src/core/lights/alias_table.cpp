#include "core/lights/alias_table.h"

#include <algorithm>
#include <numeric>

namespace photopic {

AliasTable::AliasTable(std::span<const double> weights) : bins_(weights.size()) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> share(weights.size());
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    bins_[i].alias = i;
    bins_[i].probability = static_cast<float>(weights[i] / total);
    share[i] = weights[i] / total * static_cast<double>(weights.size());
    (share[i] < 1.0 ? small : large).push_back(i);
  }
  // Fill bins of equal probability from one small and one large entry each; what rounding leaves is full.
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    bins_[s].keep = share[s];
    bins_[s].alias = l;
    share[l] -= 1.0 - share[s];
    if (share[l] < 1.0) {
      large.pop_back();
      small.push_back(l);
    }
  }
}

std::uint32_t AliasTable::sample_bins(double& u) const {
  const double scaled = u * static_cast<double>(bins_.size());
  const auto i = std::min(static_cast<std::uint32_t>(scaled), static_cast<std::uint32_t>(bins_.size() - 1));
  const Bin& bin = bins_[i];
  const double rest = scaled - i;
  if (rest < bin.keep) {
    u = std::min(rest / bin.keep, 1.0 - 0x1p-53);
    return i;
  }
  u = std::min((rest - bin.keep) / (1.0 - bin.keep), 1.0 - 0x1p-53);
  return bin.alias;
}

}  // namespace photopic
