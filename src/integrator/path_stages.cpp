#include "integrator/path_stages.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace photopic {
namespace {

/// Enough to tell materials apart.
constexpr std::size_t kBucketsPerKind = 16;
constexpr std::size_t kBuckets = kBucketsPerKind * kBsdfKinds;
static_assert(kBuckets < 256);

}  // namespace

template <int N, Features kHas>
PathTracer<N, kHas>::PathTracer(const PreparedScene& scene, const CompiledSampler& sampler,
                                const RenderOptions& options)
    : scene_(scene),
      sampler_(sampler),
      options_(options),
      batch_(static_cast<std::size_t>(options.batch_size), options.sequence, scene, sampler),
      shading_(scene),
      hides_lamps_(has_media() && std::ranges::any_of(scene.shapes, is_hideable)) {
  if (has_media()) camera_media_ = media_at(scene, scene.scene.camera.position);
}

template <int N, Features kHas>
void PathTracer<N, kHas>::trace(std::span<const PathKey> paths, Film& film) {
  done(kStageBetween);
  advance(paths);
  finish(paths, film);
  done(kStageFilm);
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
    if (kHas.textures) prefetch_texels();
    done(kStageSort);
    batch_.active.clear();
    batch_.shadowed.clear();
    stats_.split_paths += shading_.shade(batch_, depth, watch_);
    trace_shadow_rays(depth);
    done(kStageShadow);
  }
}

template <int N, Features kHas>
void PathTracer<N, kHas>::start(std::span<const PathKey> paths) {
  batch_.active.fill(static_cast<std::uint32_t>(paths.size()));
  for (std::uint32_t slot = 0; slot < paths.size(); ++slot) batch_.pixel[slot] = paths[slot].pixel;
  for (std::size_t first = 0; first < paths.size(); first += kLanes) {
    const Packet packet(batch_.active, first);
    UintLanes sample;
    for (int i = 0; i < kLanes; ++i) sample[i] = paths[packet[i]].sample;
    const UintLanes pixel = gather(batch_.pixel.data(), packet);
    const SampleStreamLanes stream(options_.sequence, UintLanes{} + options_.seed, pixel, sample);
    batch_.stream.scatter(packet, stream);
    draw_wavelengths(packet, stream.bits(kWavelength));
    leave_camera(packet, camera_rays(scene_.scene.camera, pixel, stream));
  }
  stats_.paths += paths.size();
}

template <int N, Features kHas>
void PathTracer<N, kHas>::draw_wavelengths(const Packet& packet, UintLanes bits) {
  const WavelengthLanes<N> drawn = sampler_.draw<N>(bits);
  const auto [x, y, z, emission] = sampler_.look_up(drawn, 0);
  const auto lambda = by_lane(drawn.lambda), weight = by_lane(drawn.weight), wx = by_lane(drawn.weight * x),
             wy = by_lane(drawn.weight * y), wz = by_lane(drawn.weight * z);
  for (int i = 0; i < packet.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    batch_.wavelengths[packet[i]] = {lambda[k], weight[k], {wx[k], wy[k], wz[k]}};
    if (kHas.environment && !batch_.tints.empty()) batch_.tints[packet[i]] = SampledTints<N>(lambda[k]);
  }
  batch_.emission.set(packet, drawn, emission);
}

template <int N, Features kHas>
void PathTracer<N, kHas>::leave_camera(const Packet& packet, const RayLanes& rays) {
  batch_.rays.scatter(packet, rays);
  for (int i = 0; i < packet.count; ++i) {
    const std::uint32_t slot = packet[i];
    batch_.throughput[slot] = SampledSpectrum<N>(1.0f);
    batch_.radiance[slot] = SampledSpectrum<N>(0.0f);
    batch_.vertex.set_w(slot, 0.0f);
    if (kHas.media) batch_.eta_scale[slot] = 1.0f;
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
    if (batch_.hits[slot].shape != kNoHit || is_lost(slot)) continue;
    const Vec3f direction = batch_.rays.direction[slot], rgb = environment.radiance(direction);
    SampledSpectrum<N> arriving = batch_.throughput[slot] * batch_.tints[slot](rgb.x, rgb.y, rgb.z) *
                                  batch_.emission(slot, environment.emission_spectrum);
    if (has_media())
      attenuate(arriving, scene_, batch_.media[slot].current(), batch_.wavelengths[slot].lambda,
                std::numeric_limits<float>::infinity());
    if (const float pdf = batch_.vertex.w(slot); pdf != 0.0f)
      arriving *= power_heuristic(
          pdf, scene_.lights.environment_pdf(batch_.vertex_of(slot), batch_.groups_of(slot), direction));
    batch_.radiance[slot] += arriving;
  }
}

/// What happens on the way to the hit and at it, whatever the BSDF: absorption in glass, light from a lamp
/// that was hit.
template <int N, Features kHas>
void PathTracer<N, kHas>::absorb_and_emit() {
  const Geometry& geometry = scene_.scene.geometry;
  if (kHas.environment && scene_.scene.environment) escape();
  batch_.active.keep_if([&](std::uint32_t slot) { return batch_.hits[slot].shape != kNoHit; });
  if (has_media()) batch_.active.keep_if([&](std::uint32_t slot) { return travel(slot); });
  for (const std::uint32_t slot : batch_.active) {
    const ShapeTraits& shape = traits_at(slot);
    if (!shape.emits || (has_media() && batch_.media[slot].hidden())) continue;
    const Hit& hit = batch_.hits[slot];
    const Surface& surface = scene_.surfaces[shape.material];
    if (!surface.double_sided && !meets_front(geometry, hit, batch_.rays.direction[slot])) continue;
    float weight = surface.emission_luminance;
    if (const float pdf = batch_.vertex.w(slot); pdf != 0.0f)
      weight *= power_heuristic(pdf, scene_.lights.pdf(batch_.vertex_of(slot), batch_.groups_of(slot),
                                                       hit.shape, hit.triangle, flight(slot)));
    SampledSpectrum<N> emitted = batch_.emission(slot, surface.emission_spectrum);
    if (kHas.textures && surface.emission_varies)
      emitted *=
          ShadingMaterial<N>(surface, batch_.wavelengths[slot].lambda, {geometry, hit}).emission_tint();
    batch_.radiance[slot] += batch_.throughput[slot] * emitted * weight;
  }
}

/// Which of a surface's BSDFs shades the path, where it has two.
template <int N, Features kHas>
BsdfKind PathTracer<N, kHas>::choose_kind(std::uint32_t slot, int depth) const {
  const ShadingMaterial<N> material(
      scene_.surfaces[traits_at(slot).material], batch_.wavelengths[slot].lambda,
      {scene_.scene.geometry, batch_.hits[slot]}, batch_.outside_of(slot, scene_));
  return material.choose_kind(batch_.stream[slot].get_1d(bounce_dimension(depth, kBsdfChoice)));
}

/// Paths with one kind of BSDF stand side by side, among them those at one material, so that in most packets
/// branches go one way.
template <int N, Features kHas>
void PathTracer<N, kHas>::sort_by_bsdf(int depth) {
  std::array<std::uint32_t, kBuckets + 2> first{};
  for (std::size_t i = 0; i < batch_.active.size(); ++i) {
    const std::uint32_t slot = batch_.active[i];
    const ShapeTraits& shape = traits_at(slot);
    const BsdfKind kind = shape.transmits ? choose_kind(slot, depth) : shape.opaque_kind;
    const std::size_t bucket =
        static_cast<std::size_t>(kind) * kBucketsPerKind + shape.material % kBucketsPerKind;
    batch_.bucket[i] = static_cast<std::uint8_t>(shape.scatters ? bucket : kBuckets);
    ++first[batch_.bucket[i] + 1u];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (std::size_t kind = 0; kind < kBsdfKinds; ++kind) {
    const std::uint32_t begin = first[kind * kBucketsPerKind], end = first[(kind + 1) * kBucketsPerKind];
    batch_.by_kind[kind] = std::span(batch_.sorted).subspan(begin, end - begin);
  }
  for (std::size_t i = 0; i < batch_.active.size(); ++i)
    batch_.sorted[first[batch_.bucket[i]]++] = batch_.active[i];
}

template <int N, Features kHas>
void PathTracer<N, kHas>::prefetch_texels() {
  for (const auto& slots : batch_.by_kind)
    for (const std::uint32_t slot : slots)
      scene_.surfaces[traits_at(slot).material].prefetch({scene_.scene.geometry, batch_.hits[slot]});
}

template <int N, Features kHas>
void PathTracer<N, kHas>::trace_shadow_rays(int depth) {
  scene_.accel.occluded(batch_.shadow_rays, batch_.shadowed, batch_.shadows);
  stats_.shadow_rays += batch_.shadowed.size();
  batch_.shadowed.keep_if([&](std::uint32_t slot) { return batch_.shadows[slot] != Shadow::blocked; });
  if (hides_lamps_) batch_.shadowed.keep_if([&](std::uint32_t slot) { return !is_hidden_lamp(slot); });
  if (batch_.has_panes())
    for (const std::uint32_t slot : batch_.shadowed)
      if (batch_.shadows[slot] == Shadow::by_panes) dim_by_panes(slot, depth);
  for (const std::uint32_t slot : batch_.shadowed) batch_.radiance[slot] += batch_.shadow_radiance[slot];
}

/// As far as BSDF sampling, which meets each pane as a surface, would find the light; or no path would.
template <int N, Features kHas>
void PathTracer<N, kHas>::dim_by_panes(std::uint32_t slot, int depth) {
  const int most = batch_.by_delta_light[slot] ? kMostPanes : options_.max_depth - depth - 1;
  const RayArray& rays = batch_.shadow_rays;
  batch_.shadow_radiance[slot] *=
      through_panes(scene_, rays[slot], rays.t_max(slot), batch_.wavelengths[slot].lambda, most);
}

/// From the last vertex to the hit, through panes [m].
template <int N, Features kHas>
float PathTracer<N, kHas>::flight(std::uint32_t slot) const {
  const float last = batch_.hits[slot].t;
  if (!batch_.has_panes()) return last;
  return last + length(batch_.rays.origin[slot] - batch_.vertex[slot]);
}

// What other files use: of the whole class, members that they define would be weak references, which
// link-time optimisation does not find in libraries.
#define PHOTOPIC_LOOP(N, features)                                                           \
  template PathTracer<N, features>::PathTracer(const PreparedScene&, const CompiledSampler&, \
                                               const RenderOptions&);                        \
  template void PathTracer<N, features>::trace(std::span<const PathKey>, Film&);             \
  template void PathTracer<N, features>::advance(std::span<const PathKey>);                  \
  template void PathTracer<N, features>::intersect(bool);                                    \
  template void PathTracer<N, features>::absorb_and_emit();
PHOTOPIC_FOR_EACH_LOOP(PHOTOPIC_LOOP)
#undef PHOTOPIC_LOOP

}  // namespace photopic
