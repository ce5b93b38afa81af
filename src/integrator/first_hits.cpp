#include "integrator/first_hits.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/fresnel.h"
#include "integrator/path_start.h"
#include "integrator/vertex.h"
#include "spectral/reflectance_color.h"

namespace photopic {
namespace {

/// Saturated reflectances lie outside sRGB's gamut.
Vec3f clamped(const Rgb& c) {
  const auto clamp = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
  return {clamp(c.r), clamp(c.g), clamp(c.b)};
}

/// At normal incidence, from air.
Spectrum normal_reflectance(const ConductorIndex& index) {
  std::vector<double> lambda, value;
  for (double l = kLambdaMin; l <= kLambdaMax; l += 1.0) {
    lambda.push_back(l);
    value.push_back(fresnel_conductor(1.0f, static_cast<float>(index.n(l)), static_cast<float>(index.k(l))));
  }
  return TabulatedSpectrum(std::move(lambda), std::move(value), Beyond::end_value);
}

/// Of a surface where nothing varies it.
Vec3f uniform_albedo(const Surface& surface) {
  const bool metal = surface.extensions && surface.extensions->conductor;
  return clamped(
      color_under_d65(metal ? normal_reflectance(*surface.extensions->conductor) : surface.base_color));
}

/// Finds the first hits of one pixel after another.
class FirstHitTracer {
 public:
  explicit FirstHitTracer(const PreparedScene& scene) : scene_(scene) {
    for (const Surface& surface : scene.surfaces) albedos_.push_back(uniform_albedo(surface));
  }

  /// Into a pixel of `hits`. @param samples how many to look at
  void trace(std::uint32_t pixel, std::uint32_t samples, Sequence sequence, std::uint32_t seed,
             FirstHits& hits) const {
    const Camera& camera = scene_.scene.camera;
    Vec3f albedo, normal;
    double depth = 0.0, met = 0.0;
    for (std::uint32_t s = 0; s < samples; ++s) {
      const Ray ray = camera_ray(camera, pixel, SampleStream(sequence, seed, pixel, s));
      const Hit hit = scene_.accel.intersect(ray);
      if (hit.shape == kNoHit) continue;
      albedo = albedo + albedo_at(hit);
      normal = normal + normal_at(hit, -ray.direction);
      depth += dot(ray.origin + ray.direction * hit.t - camera.position, -camera.back);
      met += 1.0;
    }
    if (met == 0.0) return;
    const float share = 1.0f / static_cast<float>(samples);
    hits.albedo.set(pixel, albedo.x * share, albedo.y * share, albedo.z * share);
    hits.normal.set(pixel, normal.x * share, normal.y * share, normal.z * share);
    hits.depth[pixel] = static_cast<float>(depth / met);
  }

 private:
  /// As ShadingMaterial::base_color() has it.
  Vec3f albedo_at(const Hit& hit) const {
    const std::uint32_t material = scene_.shapes[hit.shape].material;
    const Surface& surface = scene_.surfaces[material];
    if (surface.unlit) return surface.emissive_rgb({scene_.scene.geometry, hit});
    const bool metal = surface.extensions && surface.extensions->conductor;
    if (!surface.base_varies || metal) return albedos_[material];
    const Vec3f rgb = surface.base_rgb({scene_.scene.geometry, hit});
    return surface.base_is_measured ? albedos_[material] * std::min(luminance(rgb), 1.0f) : rgb;
  }

  Vec3f normal_at(const Hit& hit, Vec3f wo) const {
    const Geometry& geometry = scene_.scene.geometry;
    const Surface& surface = scene_.surfaces[geometry.shapes[hit.shape].material];
    return shading_frame(mapped_point(geometry, hit, wo, surface), wo, true).n;
  }

  const PreparedScene& scene_;
  std::vector<Vec3f> albedos_;  ///< of surfaces where nothing varies them
};

}  // namespace

FirstHits first_hits(const PreparedScene& scene, const Film& film, Sequence sequence, std::uint32_t seed,
                     const std::atomic<bool>& hurry) {
  const int width = film.width(), height = film.height();
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  FirstHits hits{Image(width, height), Image(width, height), std::vector<float>(pixels)};
  const FirstHitTracer tracer(scene);
  tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t pixel) {
    const std::uint64_t most = hurry.load(std::memory_order_relaxed) ? 1 : kMostFirstHits;
    const auto samples = static_cast<std::uint32_t>(std::min(film.count(pixel), most));
    tracer.trace(static_cast<std::uint32_t>(pixel), samples, sequence, seed, hits);
  });
  return hits;
}

}  // namespace photopic
