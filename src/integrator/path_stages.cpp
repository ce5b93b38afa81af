#include "integrator/path_stages.h"

#include <limits>

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
                          const RenderOptions& options, const WavelengthTable& table)
    : scene_(scene),
      sampler_(wavelengths),
      options_(options),
      table_(table),
      batch_(static_cast<std::size_t>(options.batch_size), scene) {}

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
  for (const std::uint32_t slot : batch_.active)
    batch_.sampled[slot] = sample_wavelengths<N>(sampler_, wavelength_u(batch_.stream[slot]));
  for (const std::uint32_t slot : batch_.active) {
    const auto& sampled = batch_.sampled[slot];
    batch_.wavelengths[slot] =
        PathWavelengths<N>(sampled, table_.look_up<N>(sampled.lambda, batch_.emissions_of(slot)));
    if (!batch_.tints.empty()) batch_.tints[slot] = SampledTints<N>(batch_.wavelengths[slot].lambda);
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

/// Light from the environment, where paths leave the scene.
template <int N>
void PathTracer<N>::escape() {
  const Environment& environment = *scene_.scene.environment;
  for (const std::uint32_t slot : batch_.active) {
    if (batch_.hits[slot].shape != kNoHit) continue;
    const Vec3f direction = batch_.rays.direction[slot], rgb = environment.radiance(direction);
    SampledSpectrum<N> arriving = batch_.throughput[slot] * batch_.tints[slot](rgb.x, rgb.y, rgb.z) *
                                  batch_.emission_of(slot, environment.emission_spectrum);
    if (batch_.medium[slot] >= 0)
      arriving *= scene_.surfaces[static_cast<std::size_t>(batch_.medium[slot])].transmittance(
          batch_.wavelengths[slot].lambda, std::numeric_limits<float>::infinity());
    if (const float pdf = batch_.bsdf_pdf[slot]; pdf != 0.0f)
      arriving *= power_heuristic(
          pdf, scene_.lights.environment_pdf(batch_.vertex_of(slot), batch_.spectra_of(slot), direction));
    batch_.radiance[slot] += arriving;
  }
}

/// What happens on the way to the hit and at it, whatever the BSDF: absorption in glass, light from a lamp
/// that was hit.
template <int N>
void PathTracer<N>::absorb_and_emit() {
  const Geometry& geometry = scene_.scene.geometry;
  if (scene_.scene.environment) escape();
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
      weight *= power_heuristic(pdf, scene_.lights.pdf(batch_.vertex_of(slot), batch_.spectra_of(slot),
                                                       hit.shape, hit.triangle, hit.t));
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

/// Where lights differ in spectrum: what those of each may add to this path.
template <int N>
void PathTracer<N>::weigh_spectra(std::uint32_t slot) {
  const std::span<float> spectra = batch_.spectra_of(slot);
  if (spectra.empty()) return;
  const SampledSpectrum<N> importance = batch_.throughput[slot] * batch_.wavelengths[slot].importance();
  for (std::size_t k = 0; k < spectra.size(); ++k)
    spectra[k] = (importance * batch_.emission_of(slot, static_cast<int>(k))).sum();
  scene_.lights.spectrum_probabilities(spectra);
}

/// What varies over a lamp, at the point that was chosen.
template <int N>
SampledSpectrum<N> PathTracer<N>::lamp_tint(std::uint32_t slot, const LightSample& light) const {
  const Surface& lamp = scene_.surfaces[light.material];
  if (!lamp.emission_varies && !lamp.partly_covers) return SampledSpectrum<N>(1.0f);
  const TrianglePoint point = triangle_point_at(scene_.scene.geometry, light.triangle, light.end);
  return ShadingMaterial<N>(lamp, batch_.wavelengths[slot].lambda, point).emission_tint() *
         lamp.coverage(point);
}

/// Next-event estimation: a direction to a light, weighted against finding it by the BSDF.
template <int N>
template <typename Bsdf>
void PathTracer<N>::sample_light(std::uint32_t slot, int depth, const Vertex<N, Bsdf>& vertex) {
  if (scene_.lights.empty()) return;
  weigh_spectra(slot);
  if (scene_.lights.uses_normals()) batch_.normal.set(slot, vertex.lit_side());
  const SampleStream& stream = batch_.stream[slot];
  const std::optional<LightSample> light =
      scene_.lights.sample({vertex.point.position, vertex.lit_side()}, batch_.spectra_of(slot),
                           stream.get_1d_fine(bounce_dimension(depth, kLightChoice)),
                           stream.get_2d(bounce_dimension(depth, kLightPoint)));
  if (!light) return;

  // What would arrive?
  const Vec3f wi = light->direction;
  const BsdfValue<N> value = vertex.evaluate(wi);
  if (value.pdf == 0.0f) return;
  const float mis = light->delta ? 1.0f : power_heuristic(light->pdf, value.pdf);
  SampledSpectrum<N> arriving = batch_.throughput[slot] * value.f_cos *
                                batch_.emission_of(slot, light->spectrum) *
                                (light->radiance * mis / light->pdf);
  if (light->environment) {
    const Vec3f rgb = scene_.scene.environment->radiance(wi);
    arriving *= batch_.tints[slot](rgb.x, rgb.y, rgb.z);
  }
  if (light->material != kNoMaterial) arriving *= lamp_tint(slot, *light);
  if (arriving.is_black()) return;
  if (const int medium = vertex.medium_towards(wi, batch_.medium[slot]); medium >= 0)
    arriving *= scene_.surfaces[static_cast<std::size_t>(medium)].transmittance(
        batch_.wavelengths[slot].lambda, light->distance);

  const bool unbounded = std::isinf(light->distance);
  const Vec3f origin = vertex.point.leave(wi);
  batch_.shadow_rays.origin.set(slot, origin);
  batch_.shadow_rays.direction.set(slot, unbounded ? wi : light->end - origin);
  batch_.shadow_rays.t_max[slot] = unbounded ? light->distance : 1.0f;
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
