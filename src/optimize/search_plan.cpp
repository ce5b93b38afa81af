#include "optimize/search_plan.h"

#include <algorithm>
#include <bit>

namespace photopic {

std::vector<SearchLevel> search_plan(int wavelengths, int starts) {
  constexpr int kFinest = 192;
  // Three cells to a stratum of equal width at the least.
  const int crowd = static_cast<int>(std::bit_ceil(static_cast<unsigned>((wavelengths + 3) / 4)));
  int cells = 12 * crowd, strata = 64 * crowd, candidates = std::max(8, starts / (crowd * crowd));

  std::vector<SearchLevel> levels{{candidates, cells + 1, strata, 30, 1e-3}};
  for (int keep = 8; cells < kFinest; keep = 2) {
    cells *= 2, strata *= 2, candidates = std::max(2, candidates / keep);
    levels.push_back({candidates, cells + 1, strata, 200, 1e-4});
  }
  levels.back().evaluations = 600;
  levels.back().tolerance = 1e-5;
  return levels;
}

}  // namespace photopic
