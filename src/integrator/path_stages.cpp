#include "integrator/path_stages.h"

#include "core/conductor_bsdf.h"
#include "core/glass_bsdf.h"
#include "core/layered_bsdf.h"
#include "core/opaque_bsdf.h"
#include "core/spectral_glass_bsdf.h"

namespace photopic {
namespace {

/// Roulette spares the first bounces: they carry most of the light.
constexpr int kRouletteDepth = 3;

}  // namespace

template <int N>
PathTracer<N>::PathTracer(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                          const RenderOptions& options)
    : scene_(scene),
      sampler_(wavelengths),
      options_(options),
      batch_(static_cast<std::size_t>(options.batch_size), scene.scene.emission_spectra.size()) {}

template <int N>
void PathTracer<N>::trace(std::span<const PathKey> paths, Film& film) {
  start(paths);
  for (int depth = 1; !batch_.active.empty(); ++depth) {
    intersect();
    absorb_and_emit();
    if (depth == options_.max_depth) break;
    sort_by_bsdf(depth);
    batch_.active.clear();
    batch_.shadowed.clear();
    shade<DiffuseBsdf<N>>(batch_.by_kind[static_cast<int>(BsdfKind::diffuse)], depth);
    shade<OpaqueBsdf<N>>(batch_.by_kind[static_cast<int>(BsdfKind::opaque)], depth);
    shade<ConductorBsdf<N>>(batch_.by_kind[static_cast<int>(BsdfKind::conductor)], depth);
    shade<LayeredBsdf<N>>(batch_.by_kind[static_cast<int>(BsdfKind::layered)], depth);
    shade<GlassBsdf<N>>(batch_.by_kind[static_cast<int>(BsdfKind::glass)], depth);
    shade<SpectralGlassBsdf<N>>(batch_.by_kind[static_cast<int>(BsdfKind::spectral_glass)], depth);
    trace_shadow_rays();
    roulette(depth);
  }
  finish(paths.size(), film);
}

template <int N>
void PathTracer<N>::start(std::span<const PathKey> paths) {
  batch_.active.clear();
  for (std::uint32_t slot = 0; slot < paths.size(); ++slot) {
    batch_.pixel[slot] = paths[slot].pixel;
    batch_.stream[slot] =
        SampleStream(options_.sequence, options_.seed, paths[slot].pixel, paths[slot].sample);
    batch_.active.push_back(slot);
  }
  choose_wavelengths();
  leave_camera();
  stats_.paths += paths.size();
}

/// The wavelengths, and all that depends on them alone. Drawing has a loop of its own, where the look-ups of
/// neighbouring paths overlap.
template <int N>
void PathTracer<N>::choose_wavelengths() {
  const Observer& observer = *options_.observer;
  const auto& emissions = scene_.scene.emission_spectra;
  for (const std::uint32_t slot : batch_.active)
    batch_.sampled[slot] = sample_wavelengths<N>(sampler_, wavelength_u(batch_.stream[slot]));
  for (const std::uint32_t slot : batch_.active) {
    const auto& wavelengths = batch_.sampled[slot];
    batch_.wavelengths[slot] = PathWavelengths<N>(wavelengths, observer);
    for (std::size_t k = 0; k < emissions.size(); ++k)
      batch_.emission_of(slot, static_cast<int>(k)) = sample_emission<N>(emissions[k], wavelengths);
  }
}

template <int N>
void PathTracer<N>::leave_camera() {
  for (const std::uint32_t slot : batch_.active) {
    const Ray ray = camera_ray(scene_.scene.camera, batch_.pixel[slot], batch_.stream[slot]);
    batch_.rays.origin.set(slot, ray.origin);
    batch_.rays.direction.set(slot, ray.direction);
    batch_.throughput[slot] = SampledSpectrum<N>(1.0f);
    batch_.radiance[slot] = SampledSpectrum<N>(0.0f);
    batch_.bsdf_pdf[slot] = 0.0f;
    batch_.eta_scale[slot] = 1.0f;
    batch_.medium[slot] = -1;
  }
}

template <int N>
void PathTracer<N>::intersect() {
  scene_.accel.intersect(batch_.rays, batch_.active, batch_.hits);
  stats_.rays += batch_.active.size();
}

/// What happens on the way to the hit and at it, whatever the BSDF: absorption in glass, light from a lamp
/// that was hit.
template <int N>
void PathTracer<N>::absorb_and_emit() {
  const Geometry& geometry = scene_.scene.geometry;
  std::erase_if(batch_.active, [&](std::uint32_t slot) { return batch_.hits[slot].shape == kNoHit; });
  for (const std::uint32_t slot : batch_.active) {
    const Hit& hit = batch_.hits[slot];
    if (batch_.medium[slot] >= 0) {
      const Surface& medium = scene_.surfaces[static_cast<std::size_t>(batch_.medium[slot])];
      batch_.throughput[slot] *= medium.transmittance(batch_.wavelengths[slot].lambda, hit.t);
    }

    const std::uint32_t material = geometry.shapes[hit.shape].material;
    const Surface& surface = scene_.surfaces[material];
    if (!surface.emits) continue;
    const Vec3f normal = surface_point(geometry, hit).geometric_normal;
    const float cos_light = -dot(normal, batch_.rays.direction[slot]);
    if (cos_light <= 0.0f && !surface.double_sided) continue;
    float weight = surface.emission_luminance;
    if (const float pdf = batch_.bsdf_pdf[slot]; pdf != 0.0f)
      weight *= power_heuristic(pdf, scene_.lights.pdf_area(material) * sqr(hit.t) / std::abs(cos_light));
    SampledSpectrum<N> emitted = batch_.emission_of(slot, surface.emission_spectrum);
    if (surface.emission_varies)
      emitted *=
          ShadingMaterial<N>(surface, batch_.wavelengths[slot].lambda, {geometry, hit}).emission_tint();
    batch_.radiance[slot] += batch_.throughput[slot] * emitted * weight;
  }
}

template <int N>
void PathTracer<N>::sort_by_bsdf(int depth) {
  for (auto& queue : batch_.by_kind) queue.clear();
  for (const std::uint32_t slot : batch_.active) {
    const Surface& surface = scene_.surfaces[scene_.scene.geometry.shapes[batch_.hits[slot].shape].material];
    BsdfKind kind = surface.opaque_kind;
    if (surface.transmits)
      kind = ShadingMaterial<N>(surface, batch_.wavelengths[slot].lambda,
                                {scene_.scene.geometry, batch_.hits[slot]})
                 .choose_kind(batch_.stream[slot].get_1d(bounce_dimension(depth, kBsdfChoice)));
    batch_.by_kind[static_cast<std::size_t>(kind)].push_back(slot);
  }
}

template <int N>
template <typename Bsdf>
void PathTracer<N>::shade(std::span<const std::uint32_t> slots, int depth) {
  for (const std::uint32_t slot : slots) {
    const Vertex<N, Bsdf> vertex(scene_, batch_.hits[slot], -batch_.rays.direction[slot],
                                 batch_.wavelengths[slot].lambda, batch_.throughput[slot]);
    sample_light(slot, depth, vertex);
    sample_direction(slot, depth, vertex);
  }
}

/// Next-event estimation: a point of a lamp, weighted against finding it by the BSDF.
template <int N>
template <typename Bsdf>
void PathTracer<N>::sample_light(std::uint32_t slot, int depth, const Vertex<N, Bsdf>& vertex) {
  if (scene_.lights.empty()) return;
  const SampleStream& stream = batch_.stream[slot];
  const LightSample light = scene_.lights.sample(stream.get_1d_fine(bounce_dimension(depth, kLightChoice)),
                                                 stream.get_2d(bounce_dimension(depth, kLightPoint)));
  const Surface& lamp = scene_.surfaces[light.material];

  // Is the lamp's bright side seen from here?
  const Vec3f to_light = light.point - vertex.point.position;
  const float distance = length(to_light);
  const Vec3f wi = to_light / distance;
  const float cos_light = -dot(light.normal, wi);
  if (cos_light == 0.0f || (cos_light < 0.0f && !lamp.double_sided)) return;

  // What would arrive?
  const BsdfValue<N> value = vertex.evaluate(wi);
  if (value.pdf == 0.0f) return;
  const float pdf = light.pdf_area * sqr(distance) / std::abs(cos_light);
  SampledSpectrum<N> arriving = batch_.throughput[slot] * value.f_cos *
                                batch_.emission_of(slot, lamp.emission_spectrum) *
                                (lamp.emission_luminance * power_heuristic(pdf, value.pdf) / pdf);
  if (lamp.emission_varies || lamp.partly_covers) {
    const TrianglePoint point(scene_.scene.geometry, light.triangle, light.uv.x, light.uv.y);
    arriving *= ShadingMaterial<N>(lamp, batch_.wavelengths[slot].lambda, point).emission_tint() *
                lamp.coverage(point);
  }
  if (arriving.is_black()) return;
  if (const int medium = vertex.medium_towards(wi, batch_.medium[slot]); medium >= 0)
    arriving *= scene_.surfaces[static_cast<std::size_t>(medium)].transmittance(
        batch_.wavelengths[slot].lambda, distance);

  const Vec3f origin = vertex.point.leave(wi);
  batch_.shadow_rays.origin.set(slot, origin);
  batch_.shadow_rays.direction.set(slot, light.leave(-wi) - origin);
  batch_.shadow_rays.t_max[slot] = 1.0f;
  batch_.shadow_radiance[slot] = arriving;
  batch_.shadowed.push_back(slot);
}

/// Where the path goes on.
template <int N>
template <typename Bsdf>
void PathTracer<N>::sample_direction(std::uint32_t slot, int depth, const Vertex<N, Bsdf>& vertex) {
  const SampleStream& stream = batch_.stream[slot];
  const auto sample = vertex.sample(stream.get_1d(bounce_dimension(depth, kBsdfLobe)),
                                    stream.get_2d(bounce_dimension(depth, kBsdfDirection)));
  if (!sample) return;
  batch_.throughput[slot] *= sample->weight;
  stats_.split_paths += sample->split;
  if (batch_.throughput[slot].is_black()) return;
  batch_.rays.origin.set(slot, vertex.point.leave(sample->wi));
  batch_.rays.direction.set(slot, sample->wi);
  batch_.bsdf_pdf[slot] = sample->delta ? 0.0f : sample->pdf;
  batch_.eta_scale[slot] *= sqr(sample->eta);
  batch_.medium[slot] = vertex.medium_towards(sample->wi, batch_.medium[slot]);
  batch_.active.push_back(slot);
}

template <int N>
void PathTracer<N>::trace_shadow_rays() {
  scene_.accel.occluded(batch_.shadow_rays, batch_.shadowed, batch_.blocked);
  stats_.shadow_rays += batch_.shadowed.size();
  for (const std::uint32_t slot : batch_.shadowed)
    if (!batch_.blocked[slot]) batch_.radiance[slot] += batch_.shadow_radiance[slot];
}

/// Ends paths with the probability 1 − max β: the brightest wavelength decides, so none is thrown away that
/// counts.
template <int N>
void PathTracer<N>::roulette(int depth) {
  if (depth < kRouletteDepth) return;
  std::erase_if(batch_.active, [&](std::uint32_t slot) {
    const float survival = batch_.throughput[slot].max() * batch_.eta_scale[slot];
    if (survival >= 1.0f) return false;
    if (batch_.stream[slot].get_1d(bounce_dimension(depth, kRoulette)) >= survival) return true;
    batch_.throughput[slot] *= 1.0f / survival;
    return false;
  });
}

/// In the order of the slots: a pixel's sum has the same bits however its paths were batched.
template <int N>
void PathTracer<N>::finish(std::size_t count, Film& film) {
  for (std::size_t slot = 0; slot < count; ++slot) {
    const Xyz xyz = batch_.wavelengths[slot].to_xyz(batch_.radiance[slot]);
    if (std::isfinite(xyz.x + xyz.y + xyz.z))
      film.add(batch_.pixel[slot], xyz);
    else
      ++stats_.non_finite;
  }
}

template class PathTracer<1>;
template class PathTracer<4>;
template class PathTracer<8>;
template class PathTracer<16>;

}  // namespace photopic
