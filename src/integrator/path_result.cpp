#include <utility>

#include "integrator/path_stages.h"

namespace photopic {

/// In the order of the slots: a pixel's sum has the same bits however its paths were batched.
template <int N, Features kHas>
void PathTracer<N, kHas>::finish(std::span<const PathKey> paths, Film& film) {
  std::vector<PathKey> non_finite;
  for (std::size_t slot = 0; slot < paths.size(); ++slot) {
    if (has_media()) {
      stats_.media_overflows += batch_.media[slot].overflowed();
      stats_.media_slips += batch_.media[slot].slipped();
    }
    const PathWavelengths<N>& w = batch_.wavelengths[slot];
    const Xyz xyz = w.to_xyz(batch_.radiance[slot]);
    if (std::isfinite(xyz.x + xyz.y + xyz.z) && !is_lost(slot)) {
      film.add(batch_.pixel[slot], xyz);
      options_.further.add(batch_.pixel[slot], xyz, w.lambda, batch_.radiance[slot] * w.weight);
    } else {
      non_finite.push_back(paths[slot]);
    }
  }
  if (!non_finite.empty()) count_non_finite(non_finite);
}

/// Traces the paths once more to see what goes wrong: the same numbers take them the same way.
template <int N, Features kHas>
void PathTracer<N, kHas>::count_non_finite(std::span<const PathKey> paths) {
  const RenderStats before = stats_;
  NonFiniteWatch<N> watch(batch_, paths.size());
  StageWatch* const other = std::exchange(watch_, &watch);
  advance(paths);
  watch_ = other;
  stats_ = before;
  stats_.non_finite += paths.size();
  stats_.non_finite_causes += watch.counts();
}

#define PHOTOPIC_LOOP(N, features) \
  template void PathTracer<N, features>::finish(std::span<const PathKey>, Film&);
PHOTOPIC_FOR_EACH_LOOP(PHOTOPIC_LOOP)
#undef PHOTOPIC_LOOP

}  // namespace photopic
