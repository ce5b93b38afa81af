#include <algorithm>

#include "integrator/path_stages.h"

namespace photopic {

/// The stages of paths in scenes that have media.

/// From the last vertex to the hit. @return whether anything is left
template <int N, Features kHas>
bool PathTracer<N, kHas>::travel(std::uint32_t slot) {
  Hit& hit = batch_.hits[slot];
  PathMedia& media = batch_.media[slot];
  if (media.in_the_open() && is_lone_screen(scene_, hit)) return true;
  const SampledSpectrum<N> lambda = batch_.wavelengths[slot].lambda;
  attenuate(batch_.throughput[slot], scene_, media.current(), lambda, hit.t);
  meet(media, scene_, hit, batch_.rays.direction[slot]);
  mend(batch_.throughput[slot], scene_, media, lambda);
  return !batch_.throughput[slot].is_black();
}

/// Paths go on through surfaces that are hidden, which do not count as met. Light samples end there, so what
/// lies beyond is found by this ray alone, as after a delta lobe.
template <int N, Features kHas>
void PathTracer<N, kHas>::pass_hidden_surfaces() {
  const auto is_hidden = [&](std::uint32_t slot) { return batch_.media[slot].hidden(); };
  if (std::ranges::none_of(batch_.active, is_hidden)) return;
  SlotQueue arrived(batch_.media.size());
  for (int i = 0; i < kMostHidden && !batch_.active.empty(); ++i) {
    for (const std::uint32_t slot : batch_.active)
      if (!is_hidden(slot)) arrived.push(slot);
    batch_.active.keep_if(is_hidden);
    for (const std::uint32_t slot : batch_.active) {
      const Vec3f direction = batch_.rays.direction[slot];
      batch_.rays.origin.set(slot, pass_hidden(batch_.media[slot], scene_, batch_.hits[slot], direction));
      batch_.vertex.set_w(slot, 0.0f);
    }
    intersect(false);
    absorb_and_emit();
  }
  for (const std::uint32_t slot : batch_.active) arrived.push(slot);  // are shaded where they are
  batch_.active = std::move(arrived);
}

/// Whether a light sample that nothing blocks has found a lamp that paths from there pass unseen: then it
/// counts for nothing, as they do.
template <int N, Features kHas>
bool PathTracer<N, kHas>::is_hidden_lamp(std::uint32_t slot) const {
  Ray ray = batch_.shadow_rays[slot];
  const SurfacePoint vertex = surface_point(scene_.scene.geometry, batch_.hits[slot]);
  PathMedia media = batch_.media[slot];
  media.go_on(dot(ray.direction, vertex.geometric_normal) < 0.0f);
  if (media.current() == PathMedia::kVacuum) return false;
  // The ray ends beside the lamp by what rounding may be, which is far below a hundredth of its length.
  const float distance = length(ray.direction), end = 1.01f * batch_.shadow_rays.t_max(slot);
  Hit hit = scene_.accel.intersect(ray);
  for (int i = 0; i < kMostPanes && hit.shape != kNoHit && scene_.shapes[hit.shape].is_pane; ++i) {
    const float passed = hit.t;
    ray.origin = surface_point(scene_.scene.geometry, hit).leave(ray.direction);
    hit = scene_.accel.intersect(ray);
    hit.t += passed;
  }
  if (hit.shape == kNoHit || !(hit.t < end) || !is_hideable(scene_.shapes[hit.shape])) return false;
  hit.t *= distance;
  meet(media, scene_, hit, ray.direction / distance);
  return media.hidden();
}

#define PHOTOPIC_LOOP(N, features)                               \
  template bool PathTracer<N, features>::travel(std::uint32_t);  \
  template void PathTracer<N, features>::pass_hidden_surfaces(); \
  template bool PathTracer<N, features>::is_hidden_lamp(std::uint32_t) const;
PHOTOPIC_FOR_EACH_LOOP(PHOTOPIC_LOOP)
#undef PHOTOPIC_LOOP

}  // namespace photopic
