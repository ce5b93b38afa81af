#include "integrator/panes.h"

#include <algorithm>
#include <cmath>

#include "core/bsdf/glass_reflectance.h"
#include "integrator/vertex.h"

namespace photopic {
namespace {

/// Rounding must not hold a ray for ever.
constexpr int kMostMet = 1024;

/// What GlassBsdf lets pass straight on, times the probability that it is asked.
template <int N>
SampledSpectrum<N> passed(const ShadingMaterial<N>& m, float cosine) {
  if (sqr(m.roughness()) >= kSmoothAlpha) return SampledSpectrum<N>(0.0f);
  const GlassReflectance<N> reflectance(m, false, false);
  return m.base_color() * (SampledSpectrum<N>(1.0f) - reflectance(cosine)) * m.glass_probability();
}

}  // namespace

bool has_panes(const PreparedScene& scene) {
  return std::ranges::any_of(scene.shapes, [](const ShapeTraits& shape) { return shape.is_pane; });
}

template <int N>
SampledSpectrum<N> through_panes(const PreparedScene& scene, Ray ray, float t_max, SampledSpectrum<N> lambda,
                                 int most) {
  const Vec3f end = ray.origin + ray.direction * t_max, direction = normalize(ray.direction);
  const bool unbounded = std::isinf(t_max);
  SampledSpectrum<N> share(1.0f);
  for (int i = 0, panes = 0; i < kMostMet; ++i) {
    const Hit hit = scene.accel.intersect(ray);
    if (hit.shape == kNoHit || hit.t >= t_max) return share;
    const ShapeTraits& shape = scene.shapes[hit.shape];
    const Surface& surface = scene.surfaces[shape.material];
    const SurfacePoint point = mapped_point(scene.scene.geometry, hit, -direction, surface);
    if (shape.is_pane) {
      if (panes++ == most) break;
      const float cosine = std::abs(dot(shading_frame(point, -direction, false).n, direction));
      share *= passed(ShadingMaterial<N>(surface, lambda, {scene.scene.geometry, hit}), cosine);
    } else if (!surface.partly_covers) {
      break;
    }
    if (share.is_black()) return share;
    ray.origin = point.leave(direction);
    if (!unbounded) ray.direction = end - ray.origin, t_max = 1.0f;
  }
  return SampledSpectrum<N>(0.0f);
}

#define PHOTOPIC_WIDTH(N)                                                                     \
  template SampledSpectrum<N> through_panes(const PreparedScene& scene, Ray ray, float t_max, \
                                            SampledSpectrum<N> lambda, int most);
PHOTOPIC_WIDTH(1)
PHOTOPIC_WIDTH(4)
PHOTOPIC_WIDTH(8)
PHOTOPIC_WIDTH(16)
#undef PHOTOPIC_WIDTH

}  // namespace photopic
