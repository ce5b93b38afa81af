#include "integrator/shading_stage.h"

#include "integrator/with_bsdf.h"

namespace photopic {
namespace {

/// Roulette spares the first bounces, which carry most of the light, and after them paths whose throughput is
/// one over kSpared or more: docs/benchmarks.md has the figures.
constexpr int kRouletteDepth = 3;
constexpr float kSpared = 1.5f;

/// What paths gain that go on, 0 where they end: with the probability 1 − 1.5 max β, as the brightest
/// wavelength decides, so that none is thrown away that counts. @param eta_scale see PathBatch
template <int N>
Lanes roulette_gain(const SpectrumLanes<N>& throughput, Lanes eta_scale, Lanes u) {
  const Lanes survival = kSpared * throughput.max() * eta_scale, one = Lanes{} + 1.0f;
  return select(u >= survival, Lanes{}, select(survival < 1.0f, one / survival, one));
}

}  // namespace

template <int N, Features kHas>
std::uint64_t ShadingStage<N, kHas>::shade(PathBatch<N>& batch, int depth, StageWatch* watch) {
  std::uint64_t split = 0;
  for (int k = 0; k < kBsdfKinds; ++k) {
    const auto kind = static_cast<BsdfKind>(k);
    if (batch.by_kind[static_cast<std::size_t>(k)].empty()) continue;
    with_bsdf<N>(kind,
                 [&]<typename Bsdf>(std::type_identity<Bsdf>) { split += shade<Bsdf>(batch, kind, depth); });
    if (watch) watch->after(shading_stage(kind));
  }
  return split;
}

template <int N, Features kHas>
template <typename Bsdf>
std::uint64_t ShadingStage<N, kHas>::shade(PathBatch<N>& batch, BsdfKind kind, int depth) {
  const std::span slots = batch.by_kind[static_cast<std::size_t>(kind)];
  std::uint64_t split = 0;
  for (std::size_t first = 0; first < slots.size(); first += kLanes) {
    const Packet packet(slots, first);
    const VertexPacket<N, Bsdf, kHas> vertices(scene_, batch, packet);
    const SampleStreamLanes stream = batch.stream.gather(packet);
    const IntLanes lit = packet.used() & ~vertices.bsdfs->deltas(packet);
    if (!scene_.lights.empty() && any(lit)) sample_lights(batch, packet, depth, stream, vertices, lit);
    split += sample_directions(batch, packet, depth, stream, vertices);
  }
  return split;
}

/// What each group of lights may add to this path.
template <int N, Features kHas>
std::span<const float> ShadingStage<N, kHas>::weigh_groups(PathBatch<N>& batch, std::uint32_t slot,
                                                           const LightSampler::GroupShares& shares,
                                                           int lane) const {
  const std::span<float> groups = batch.groups_of(slot);
  const SampledSpectrum<N> importance = batch.throughput[slot] * batch.wavelengths[slot].importance();
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const int spectrum = scene_.lights.spectrum_of(k);
    groups[k] = spectrum < 0 ? 1.0f : (importance * batch.emission(slot, spectrum)).sum();
  }
  scene_.lights.group_probabilities(groups, shares, lane);
  return groups;
}

/// What varies over a lamp, at the point that was chosen.
template <int N, Features kHas>
SampledSpectrum<N> ShadingStage<N, kHas>::lamp_tint(const PathBatch<N>& batch, std::uint32_t slot,
                                                    std::uint32_t material, std::uint32_t triangle,
                                                    Vec3f position) const {
  const Surface& lamp = scene_.surfaces[material];
  if (!lamp.emission_varies && !lamp.partly_covers) return SampledSpectrum<N>(1.0f);
  const TrianglePoint point = triangle_point_at(scene_.scene.geometry, triangle, position);
  return ShadingMaterial<N>(lamp, batch.wavelengths[slot].lambda, point).emission_tint() *
         lamp.coverage(point);
}

template <int N, Features kHas>
template <typename Bsdf>
LightSampleLanes ShadingStage<N, kHas>::choose_lights(PathBatch<N>& batch, const Packet& packet, int depth,
                                                      const SampleStreamLanes& stream,
                                                      const VertexPacket<N, Bsdf, kHas>& vertices,
                                                      IntLanes wanted) const {
  const Sample2dLanes u = stream.get_2d(bounce_dimension(depth, kLightPoint));
  LightSampleLanes lights;
  if (!kHas.several_lights || scene_.lights.has_only_light()) {
    scene_.lights.sample_only_light(vertices.point.position, u, lights);
    return lights;
  }
  LightReferenceLanes at{.place = {vertices.point.position, {}},
                         .groups = {},
                         .u_choice = SampleStream::fine(stream.bits(bounce_dimension(depth, kLightChoice))),
                         .u = u,
                         .count = packet.count};
  if (!Bsdf::kLitFromBehind) at.place.normal = vertices.frame.n;
  if (scene_.lights.views_differ()) at.place.view = scene_.lights.view_at(at.place);
  // Panes must leave what the vertex before them has stored.
  if (scene_.lights.uses_normals()) {
    const auto rows = rows_of(at.place.normal, std::bit_cast<Lanes>(at.place.view));
    for_each_lane(wanted, [&](int i) { batch.normal.set(packet[i], rows[static_cast<std::size_t>(i)]); });
  }
  if (scene_.lights.several_groups()) {
    const LightSampler::GroupShares shares = scene_.lights.group_shares(at.place);
    for_each_lane(wanted, [&](int i) {
      at.groups[static_cast<std::size_t>(i)] = weigh_groups(batch, packet[i], shares, i);
    });
  }
  scene_.lights.sample(at, lights);
  return lights;
}

/// Next-event estimation: a direction to a light, weighted against finding it by the BSDF.
template <int N, Features kHas>
template <typename Bsdf>
void ShadingStage<N, kHas>::sample_lights(PathBatch<N>& batch, const Packet& packet, int depth,
                                          const SampleStreamLanes& stream,
                                          const VertexPacket<N, Bsdf, kHas>& vertices, IntLanes wanted) {
  const LightSampleLanes lights = choose_lights(batch, packet, depth, stream, vertices, wanted);

  // What does the BSDF make of it?
  const Vec3Lanes local = vertices.frame.to_local(lights.direction);
  const IntLanes candidates = lights.reached & vertices.sides_agree(lights.direction, local.z) & wanted;
  const auto value = vertices.bsdfs->evaluate(local, candidates);
  const Lanes mis = select(lights.delta != 0, Lanes{} + 1.0f, power_heuristic(lights.pdf, value.pdf));
  const Lanes weight = lights.radiance * mis / lights.pdf;
  const Vec3Lanes origin = vertices.point.leave(lights.direction);
  const IntLanes unbounded = lights.distance == std::numeric_limits<float>::infinity();
  const auto origins = rows_of(origin),
             directions = rows_of(select(unbounded, lights.direction, lights.end - origin),
                                  select(unbounded, lights.distance, Lanes{} + 1.0f));
  const IntLanes inwards = vertices.is_inwards(lights.direction);

  // What would arrive?
  const SpectrumLanes<N> arriving = gather(batch.throughput.data(), packet) * value.f_cos *
                                    batch.emission.gather(packet, lights.spectrum) * weight;
  const LaneSpectra<N> by_path = by_lane(arriving);
  Vec3Lanes colors{};
  if (kHas.environment && any(lights.environment))
    colors = scene_.scene.environment->radiance(lights.direction);
  for_each_lane((value.pdf != 0.0f) & ~arriving.is_black(), [&](int i) {
    const std::uint32_t slot = packet[i];
    const auto k = static_cast<std::size_t>(i);
    SampledSpectrum<N>& radiance = batch.shadow_radiance[slot];
    radiance = by_path[k];
    if (kHas.environment && lane(lights.environment, i)) {
      const Vec3f rgb = lane(colors, i);
      radiance *= batch.tints[slot](rgb.x, rgb.y, rgb.z);
    }
    if (kHas.textures && lane(lights.material, i) != kNoMaterial)
      radiance *=
          lamp_tint(batch, slot, lane(lights.material, i), lane(lights.triangle, i), lane(lights.end, i));
    if ((kHas.environment || kHas.textures) && radiance.is_black()) return;
    if (kHas.media && !batch.media.empty())
      attenuate(radiance, scene_, batch.media[slot].on_side(lane(inwards, i)), batch.wavelengths[slot].lambda,
                lane(lights.distance, i));

    batch.shadow_rays.origin.set(slot, origins[k]);
    batch.shadow_rays.direction.set(slot, directions[k]);
    batch.shadowed.push(slot);
    if (batch.has_panes()) batch.by_delta_light[slot] = lane(lights.delta, i) ? 1 : 0;
  });
}

/// Whether a path goes on as shadow rays do.
template <int N, Features kHas>
bool ShadingStage<N, kHas>::passes_pane(const PathBatch<N>& batch, std::uint32_t slot, bool straight) const {
  return straight && scene_.shapes[batch.hits[slot].shape].is_pane;
}

/// Where the paths go on.
template <int N, Features kHas>
template <typename Bsdf>
std::uint64_t ShadingStage<N, kHas>::sample_directions(PathBatch<N>& batch, const Packet& packet, int depth,
                                                       const SampleStreamLanes& stream,
                                                       const VertexPacket<N, Bsdf, kHas>& vertices) {
  const Lanes u_lobe = stream.get_1d(bounce_dimension(depth, kBsdfLobe));
  const Sample2dLanes u = stream.get_2d(bounce_dimension(depth, kBsdfDirection));
  const DirectionSamples<N> samples = vertices.bsdfs->sample(packet, u_lobe, u);
  const Vec3Lanes wi = vertices.frame.to_world(samples.wi), origin = vertices.point.leave(wi);
  SpectrumLanes<N> throughput = gather(batch.throughput.data(), packet) * samples.weight;
  Lanes eta_scale = Lanes{} + 1.0f;
  if (kHas.media) eta_scale = gather(batch.eta_scale.data(), packet) * sqr(samples.eta);
  if (depth >= kRouletteDepth)
    throughput =
        throughput * roulette_gain(throughput, eta_scale, stream.get_1d(bounce_dimension(depth, kRoulette)));
  const IntLanes go_on = samples.found & vertices.sides_agree(wi, samples.wi.z) & ~throughput.is_black(),
                 inwards = vertices.is_inwards(wi);

  const LaneSpectra<N> by_path = by_lane(throughput);
  const auto origins = rows_of(origin), directions = rows_of(wi),
             positions = rows_of(vertices.point.position, samples.pdf);
  for_each_lane(go_on, [&](int i) {
    const std::uint32_t slot = packet[i];
    const auto k = static_cast<std::size_t>(i);
    batch.throughput[slot] = by_path[k];
    batch.rays.origin.set(slot, origins[k]);
    batch.rays.direction.set(slot, directions[k]);
    if (!passes_pane(batch, slot, lane(samples.straight, i))) batch.vertex.set(slot, positions[k]);
    if (kHas.media) batch.eta_scale[slot] = lane(eta_scale, i);
    if (kHas.media && !batch.media.empty()) batch.media[slot].go_on(lane(inwards, i));
    batch.active.push(slot);
  });
  return static_cast<std::uint64_t>(std::popcount(bits_of(go_on & samples.split)));
}

#define PHOTOPIC_LOOP(N, features) template class ShadingStage<N, features>;
PHOTOPIC_FOR_EACH_LOOP(PHOTOPIC_LOOP)
#undef PHOTOPIC_LOOP

}  // namespace photopic
