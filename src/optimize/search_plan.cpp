#include "optimize/search_plan.h"

#include <algorithm>
#include <bit>

namespace photopic {

std::vector<SearchLevel> search_plan(int wavelengths, int starts, int nodes) {
  const int finest = nodes > 0 ? nodes - 1 : 192;
  // Three cells to a stratum of equal width at the least.
  const int crowd = static_cast<int>(std::bit_ceil(static_cast<unsigned>((wavelengths + 3) / 4)));
  int cells = std::min(12 * crowd, finest), strata = 64 * crowd;
  int candidates = std::max(8, starts / (crowd * crowd));

  std::vector<SearchLevel> levels{{candidates, cells + 1, strata, 30, 1e-3}};
  for (int keep = 8; cells < finest; keep = 2) {
    cells = std::min(2 * cells, finest), strata *= 2, candidates = std::max(2, candidates / keep);
    levels.push_back({candidates, cells + 1, strata, 200, 1e-4});
  }
  levels.back().evaluations = 600;
  levels.back().tolerance = 1e-5;
  return levels;
}

}  // namespace photopic
