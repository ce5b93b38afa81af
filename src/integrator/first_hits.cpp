#include "integrator/first_hits.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/bsdf/fresnel.h"
#include "integrator/path_start.h"
#include "integrator/slot_queue.h"
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

/// Finds the first hits of one pixel after another, those of a pixel together.
class FirstHitTracer {
 public:
  explicit FirstHitTracer(const PreparedScene& scene)
      : scene_(scene), rays_(kMostFirstHits), slots_(kMostFirstHits), hits_(kMostFirstHits) {
    for (const Surface& surface : scene.surfaces) albedos_.push_back(uniform_albedo(surface));
  }

  /// Into a pixel of `hits`. @param samples how many to look at
  void trace(std::uint32_t pixel, std::uint32_t samples, Sequence sequence, std::uint32_t seed,
             FirstHits& hits) {
    slots_.fill(samples);
    start(pixel, sequence, seed);
    scene_.accel.intersect(rays_, slots_, hits_, true);
    slots_.keep_if([this](std::uint32_t slot) { return hits_[slot].shape != kNoHit; });
    if (slots_.empty()) return;
    const float share = 1.0f / static_cast<float>(samples);
    const Vec3f albedo = albedo_sum() * share, normal = normal_sum() * share;
    hits.albedo.set(pixel, albedo.x, albedo.y, albedo.z);
    hits.normal.set(pixel, normal.x, normal.y, normal.z);
    hits.depth[pixel] = static_cast<float>(depth_sum() / static_cast<double>(slots_.size()));
    hits.alpha[pixel] = static_cast<float>(slots_.size()) * share;
  }

 private:
  /// The camera rays of a pixel's samples, which are their slots' numbers.
  void start(std::uint32_t pixel, Sequence sequence, std::uint32_t seed) {
    for (std::size_t first = 0; first < slots_.size(); first += kLanes) {
      const Packet packet(slots_, first);
      const UintLanes pixels = UintLanes{} + pixel;
      const SampleStreamLanes stream(sequence, UintLanes{} + seed, pixels, gather(slots_.begin(), packet));
      rays_.scatter(packet, camera_rays(scene_.scene.camera, pixels, stream));
    }
  }

  double depth_sum() const {
    const Camera& camera = scene_.scene.camera;
    double sum = 0.0;
    for (const std::uint32_t slot : slots_) {
      const Ray ray = rays_[slot];
      sum += dot(ray.origin + ray.direction * hits_[slot].t - camera.position, -camera.back);
    }
    return sum;
  }

  Vec3f albedo_sum() const {
    Vec3f sum;
    for (const std::uint32_t slot : slots_) sum = sum + albedo_at(hits_[slot]);
    return sum;
  }

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

  Vec3f normal_sum() const {
    Vec3f sum;
    for (std::size_t first = 0; first < slots_.size(); first += kLanes) {
      const Packet packet(slots_, first);
      const Vec3Lanes n = normals_at(packet);
      for (int i = 0; i < packet.count; ++i) sum = sum + lane(n, i);
    }
    return sum;
  }

  Vec3Lanes normals_at(const Packet& packet) const {
    const Geometry& geometry = scene_.scene.geometry;
    SurfacePointLanes points = surface_points(geometry, hits_, packet);
    const Vec3Lanes wo = -rays_.direction.gather_vectors(packet);
    for (int i = 0; i < packet.count; ++i) {
      const Hit& hit = hits_[packet[i]];
      const Surface& surface = scene_.surfaces[scene_.shapes[hit.shape].material];
      if (surface.maps_normals) set_lane(points, i, mapped_point(geometry, hit, lane(wo, i), surface));
    }
    return shading_frame(points, wo, true).n;
  }

  const PreparedScene& scene_;
  std::vector<Vec3f> albedos_;  ///< of surfaces where nothing varies them

  // Of the pixel's samples, a slot each; then of those that meet something.
  RayArray rays_;
  SlotQueue slots_;
  std::vector<Hit> hits_;
};

}  // namespace

FirstHits first_hits(const PreparedScene& scene, const Film& film, Sequence sequence, std::uint32_t seed,
                     const std::atomic<bool>& hurry) {
  const int width = film.width(), height = film.height();
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  FirstHits hits{Image(width, height), Image(width, height), std::vector<float>(pixels),
                 std::vector<float>(pixels)};
  tbb::enumerable_thread_specific<FirstHitTracer> tracers([&scene] { return FirstHitTracer(scene); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels), [&](const auto& range) {
    FirstHitTracer& tracer = tracers.local();
    for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) {
      const std::uint64_t most = hurry.load(std::memory_order_relaxed) ? 1 : kMostFirstHits;
      const auto samples = static_cast<std::uint32_t>(std::min(film.count(pixel), most));
      tracer.trace(static_cast<std::uint32_t>(pixel), samples, sequence, seed, hits);
    }
  });
  return hits;
}

}  // namespace photopic
