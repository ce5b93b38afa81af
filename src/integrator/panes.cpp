#include "integrator/panes.h"

#include <algorithm>
#include <cmath>

#include "core/bsdf/glass_reflectance.h"
#include "integrator/vertex.h"

namespace photopic {
namespace {

/// More panes than any room has: rounding must not hold a ray for ever.
constexpr int kMostPanes = 64;

/// Of index 0 it is a mirror.
bool is_thin_glass(const Surface& surface) {
  return surface.transmits && !surface.solid && surface.ior != 0.0f;
}

/// What GlassBsdf lets pass straight on, times the probability that it is asked.
template <int N>
SampledSpectrum<N> passed(const ShadingMaterial<N>& m, float cosine) {
  if (!is_thin_glass(m.surface()) || sqr(m.roughness()) >= kSmoothAlpha) return SampledSpectrum<N>(0.0f);
  const GlassReflectance<N> reflectance(m, false, false);
  return m.base_color() * (SampledSpectrum<N>(1.0f) - reflectance(cosine)) * m.glass_probability();
}

}  // namespace

bool has_panes_before_lights(const PreparedScene& scene) {
  return !scene.scene.punctual_lights.empty() && std::ranges::any_of(scene.surfaces, is_thin_glass);
}

template <int N>
SampledSpectrum<N> through_panes(const PreparedScene& scene, Ray ray, float t_max,
                                 SampledSpectrum<N> lambda) {
  const Vec3f end = ray.origin + ray.direction * t_max, direction = normalize(ray.direction);
  const bool unbounded = std::isinf(t_max);
  SampledSpectrum<N> share(1.0f);
  for (int i = 0; i < kMostPanes; ++i) {
    const Hit hit = scene.accel.intersect(ray);
    if (hit.shape == kNoHit || hit.t >= t_max) return share;
    const Surface& surface = scene.surfaces[scene.shapes[hit.shape].material];
    const SurfacePoint point = mapped_point(scene.scene.geometry, hit, -direction, surface);
    const float cosine = std::abs(dot(shading_frame(point, -direction, false).n, direction));
    share *= passed(ShadingMaterial<N>(surface, lambda, {scene.scene.geometry, hit}), cosine);
    if (share.is_black()) return share;
    ray.origin = point.leave(direction);
    if (!unbounded) ray.direction = end - ray.origin, t_max = 1.0f;
  }
  return SampledSpectrum<N>(0.0f);
}

#define PHOTOPIC_WIDTH(N)                                                                     \
  template SampledSpectrum<N> through_panes(const PreparedScene& scene, Ray ray, float t_max, \
                                            SampledSpectrum<N> lambda);
PHOTOPIC_WIDTH(1)
PHOTOPIC_WIDTH(4)
PHOTOPIC_WIDTH(8)
PHOTOPIC_WIDTH(16)
#undef PHOTOPIC_WIDTH

}  // namespace photopic
