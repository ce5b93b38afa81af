#include "integrator/path_stages.h"

#include <limits>
#include <numeric>

namespace photopic {
namespace {

/// Roulette spares the first bounces, which carry most of the light, and after them paths whose throughput is
/// one over kSpared or more: docs/benchmarks.md has the figures.
constexpr int kRouletteDepth = 3;
constexpr float kSpared = 1.5f;

}  // namespace

template <int N, Features kHas>
PathTracer<N, kHas>::PathTracer(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                                const RenderOptions& options, const WavelengthTable& table)
    : scene_(scene),
      sampler_(wavelengths),
      options_(options),
      table_(table),
      batch_(static_cast<std::size_t>(options.batch_size), options.sequence, scene),
      shading_(scene) {
  if (has_media()) camera_media_ = media_at(scene, scene.scene.camera.position);
}

template <int N, Features kHas>
void PathTracer<N, kHas>::trace(std::span<const PathKey> paths, Film& film) {
  StageClock clock(stats_.stages);
  if (options_.time_stages) watch_ = &clock;
  advance(paths);
  finish(paths, film);
  done(kStageFilm);
  watch_ = nullptr;
}

template <int N, Features kHas>
void PathTracer<N, kHas>::advance(std::span<const PathKey> paths) {
  start(paths);
  done(kStageStart);
  for (int depth = 1; !batch_.active.empty(); ++depth) {
    intersect(depth == 1);
    done(kStageIntersect);
    absorb_and_emit();
    if (has_media()) pass_hidden_surfaces();
    done(kStageEmit);
    if (depth == options_.max_depth) break;
    sort_by_bsdf(depth);
    done(kStageSort);
    batch_.active.clear();
    batch_.shadowed.clear();
    batch_.pane_shadowed.clear();
    stats_.split_paths += shading_.shade(batch_, depth, watch_);
    trace_shadow_rays();
    done(kStageShadow);
    roulette(depth);
    done(kStageRoulette);
  }
}

template <int N, Features kHas>
void PathTracer<N, kHas>::start(std::span<const PathKey> paths) {
  batch_.active.resize(paths.size());
  std::iota(batch_.active.begin(), batch_.active.end(), 0u);
  for (std::uint32_t slot = 0; slot < paths.size(); ++slot) batch_.pixel[slot] = paths[slot].pixel;
  for (std::size_t first = 0; first < paths.size(); first += kLanes) {
    const Packet packet(batch_.active, first);
    UintLanes sample;
    for (int i = 0; i < kLanes; ++i) sample[i] = paths[packet[i]].sample;
    const UintLanes pixel = gather(batch_.pixel.data(), packet);
    const SampleStreamLanes stream(options_.sequence, UintLanes{} + options_.seed, pixel, sample);
    batch_.stream.scatter(packet, stream);
    draw_wavelengths(packet, stream);
    leave_camera(packet, camera_rays(scene_.scene.camera, pixel, stream));
  }
  look_up_wavelengths();
  stats_.paths += paths.size();
}

template <int N, Features kHas>
void PathTracer<N, kHas>::draw_wavelengths(const Packet& packet, const SampleStreamLanes& stream) {
  const UintLanes bits = stream.bits(kWavelength);
  for (int i = 0; i < packet.count; ++i)
    batch_.sampled[packet[i]] = sample_wavelengths<N>(sampler_, SampleStream::fine(bits[i]));
}

/// What depends on the wavelengths alone, in a loop of its own, where neighbouring paths overlap.
template <int N, Features kHas>
void PathTracer<N, kHas>::look_up_wavelengths() {
  for (const std::uint32_t slot : batch_.active) {
    const auto& sampled = batch_.sampled[slot];
    batch_.wavelengths[slot] =
        PathWavelengths<N>(sampled, table_.look_up<N>(sampled.lambda, batch_.emissions_of(slot)));
    if (kHas.environment && !batch_.tints.empty())
      batch_.tints[slot] = SampledTints<N>(batch_.wavelengths[slot].lambda);
  }
}

template <int N, Features kHas>
void PathTracer<N, kHas>::leave_camera(const Packet& packet, const RayLanes& rays) {
  batch_.rays.origin.scatter(packet, rays.origin);
  batch_.rays.direction.scatter(packet, rays.direction);
  for (int i = 0; i < packet.count; ++i) {
    const std::uint32_t slot = packet[i];
    batch_.throughput[slot] = SampledSpectrum<N>(1.0f);
    batch_.radiance[slot] = SampledSpectrum<N>(0.0f);
    batch_.bsdf_pdf[slot] = 0.0f;
    batch_.eta_scale[slot] = 1.0f;
    if (has_media()) batch_.media[slot] = camera_media_;
  }
}

template <int N, Features kHas>
void PathTracer<N, kHas>::intersect(bool coherent) {
  scene_.accel.intersect(batch_.rays, batch_.active, batch_.hits, coherent);
  stats_.rays += batch_.active.size();
}

/// Light from the environment, where paths leave the scene.
template <int N, Features kHas>
void PathTracer<N, kHas>::escape() {
  const Environment& environment = *scene_.scene.environment;
  for (const std::uint32_t slot : batch_.active) {
    if (batch_.hits[slot].shape != kNoHit) continue;
    const Vec3f direction = batch_.rays.direction[slot], rgb = environment.radiance(direction);
    SampledSpectrum<N> arriving = batch_.throughput[slot] * batch_.tints[slot](rgb.x, rgb.y, rgb.z) *
                                  batch_.emission_of(slot, environment.emission_spectrum);
    if (has_media())
      attenuate(arriving, scene_, batch_.media[slot].current(), batch_.wavelengths[slot].lambda,
                std::numeric_limits<float>::infinity());
    if (const float pdf = batch_.bsdf_pdf[slot]; pdf != 0.0f)
      arriving *= power_heuristic(
          pdf, scene_.lights.environment_pdf(batch_.vertex_of(slot), batch_.spectra_of(slot), direction));
    batch_.radiance[slot] += arriving;
  }
}

/// What happens on the way to the hit and at it, whatever the BSDF: absorption in glass, light from a lamp
/// that was hit.
template <int N, Features kHas>
void PathTracer<N, kHas>::absorb_and_emit() {
  const Geometry& geometry = scene_.scene.geometry;
  if (kHas.environment && scene_.scene.environment) escape();
  keep_if(batch_.active, [&](std::uint32_t slot) { return batch_.hits[slot].shape != kNoHit; });
  if (has_media()) keep_if(batch_.active, [&](std::uint32_t slot) { return travel(slot); });
  for (const std::uint32_t slot : batch_.active) {
    const Hit& hit = batch_.hits[slot];
    const Surface& surface = scene_.surfaces[material_at(hit)];
    if (!surface.emits) continue;
    if (!surface.double_sided && !meets_front(geometry, hit, batch_.rays.direction[slot])) continue;
    float weight = surface.emission_luminance;
    if (const float pdf = batch_.bsdf_pdf[slot]; pdf != 0.0f)
      weight *= power_heuristic(pdf, scene_.lights.pdf(batch_.vertex_of(slot), batch_.spectra_of(slot),
                                                       hit.shape, hit.triangle, hit.t));
    SampledSpectrum<N> emitted = batch_.emission_of(slot, surface.emission_spectrum);
    if (kHas.textures && surface.emission_varies)
      emitted *=
          ShadingMaterial<N>(surface, batch_.wavelengths[slot].lambda, {geometry, hit}).emission_tint();
    batch_.radiance[slot] += batch_.throughput[slot] * emitted * weight;
  }
}

/// Paths at one material stand side by side, so that in most packets branches go one way. Sixty-four buckets
/// tell materials apart well enough.
template <int N, Features kHas>
void PathTracer<N, kHas>::sort_by_material() {
  constexpr std::uint32_t kBuckets = 64;
  std::array<std::uint32_t, kBuckets + 1> first{};
  const auto bucket = [&](std::uint32_t slot) { return material_at(batch_.hits[slot]) % kBuckets; };
  for (const std::uint32_t slot : batch_.active) ++first[bucket(slot) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  batch_.sorted.resize(batch_.active.size());
  for (const std::uint32_t slot : batch_.active) batch_.sorted[first[bucket(slot)]++] = slot;
}

template <int N, Features kHas>
void PathTracer<N, kHas>::sort_by_bsdf(int depth) {
  for (auto& queue : batch_.by_kind) queue.clear();
  sort_by_material();
  for (const std::uint32_t slot : batch_.sorted) {
    const Surface& surface = scene_.surfaces[material_at(batch_.hits[slot])];
    BsdfKind kind = surface.opaque_kind;
    if (!surface.scatters) continue;
    const TrianglePoint point(scene_.scene.geometry, batch_.hits[slot]);
    if (kHas.textures) surface.prefetch(point);
    if (surface.transmits)
      kind =
          ShadingMaterial<N>(surface, batch_.wavelengths[slot].lambda, point, batch_.outside_of(slot, scene_))
              .choose_kind(batch_.stream[slot].get_1d(bounce_dimension(depth, kBsdfChoice)));
    batch_.by_kind[static_cast<std::size_t>(kind)].push_back(slot);
  }
}

template <int N, Features kHas>
void PathTracer<N, kHas>::trace_shadow_rays() {
  scene_.accel.occluded(batch_.shadow_rays, batch_.shadowed, batch_.blocked);
  stats_.shadow_rays += batch_.shadowed.size();
  keep_if(batch_.shadowed, [&](std::uint32_t slot) { return !batch_.blocked[slot]; });
  for (const std::uint32_t slot : batch_.shadowed) batch_.radiance[slot] += batch_.shadow_radiance[slot];
  for (const std::uint32_t slot : batch_.pane_shadowed) {
    if (!batch_.blocked[slot]) continue;
    const RayArray& rays = batch_.shadow_rays;
    batch_.radiance[slot] +=
        batch_.shadow_radiance[slot] * through_panes(scene_, {rays.origin[slot], rays.direction[slot]},
                                                     rays.t_max[slot], batch_.wavelengths[slot].lambda);
  }
}

/// Ends paths with the probability 1 − 1.5 max β: the brightest wavelength decides, so none is thrown away
/// that counts.
template <int N, Features kHas>
void PathTracer<N, kHas>::roulette(int depth) {
  if (depth < kRouletteDepth) return;
  std::size_t alive = 0;
  for (std::size_t first = 0; first < batch_.active.size(); first += kLanes) {
    const Packet packet(batch_.active, first);
    const Lanes u = batch_.stream.gather(packet).get_1d(bounce_dimension(depth, kRoulette));
    const Lanes survival =
        kSpared * gather(batch_.throughput.data(), packet).max() * gather(batch_.eta_scale.data(), packet);
    const Lanes gain = select(survival < 1.0f, 1.0f / survival, Lanes{} + 1.0f);
    for_each_lane(~(u >= survival) & packet.used(), [&](int i) {
      batch_.throughput[packet[i]] *= lane(gain, i);
      batch_.active[alive++] = packet[i];
    });
  }
  batch_.active.resize(alive);
}

#define PHOTOPIC_LOOP(N, features) template class PathTracer<N, features>;
PHOTOPIC_FOR_EACH_LOOP(PHOTOPIC_LOOP)
#undef PHOTOPIC_LOOP

}  // namespace photopic
