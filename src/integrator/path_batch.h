#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/accel.h"
#include "core/bsdf/bsdf.h"
#include "core/prepared_scene.h"
#include "integrator/emission_array.h"
#include "integrator/media.h"
#include "integrator/panes.h"
#include "integrator/path_start.h"
#include "integrator/slot_queue.h"
#include "spectral/path_wavelengths.h"
#include "spectral/rgb_light.h"

namespace photopic {

/// The sample streams of many paths.
class StreamArray {
 public:
  StreamArray(std::size_t size, Sequence sequence) : sequence_(sequence), streams_(size) {}
  SampleStream operator[](std::size_t i) const { return {sequence_, streams_[i][0], streams_[i][1]}; }
  void scatter(const Packet& p, const SampleStreamLanes& streams) {
    for (int i = 0; i < p.count; ++i)
      streams_[p[i]] = {lane(streams.seed(), i), lane(streams.index_reversed(), i)};
  }
  PHOTOPIC_INLINE SampleStreamLanes gather(const Packet& p) const {
    const auto [seed, index_reversed] = gather_rows<2>([&](int i) { return &streams_[p[i]]; });
    return {sequence_, reinterpret_cast<UintLanes>(seed), reinterpret_cast<UintLanes>(index_reversed)};
  }

 private:
  Sequence sequence_;
  std::vector<std::array<std::uint32_t, 2>> streams_;  ///< seeds and reversed indices
};

/// The state of many paths as structure of arrays, an entry a slot. Slots stay; queues of slot numbers shrink
/// as paths end.
template <int N>
struct PathBatch {
  /// What a scene does not have is not stored.
  PathBatch(std::size_t capacity, Sequence sequence, const PreparedScene& scene,
            const CompiledSampler& sampler)
      : rays(capacity),
        hits(capacity),
        pixel(capacity),
        stream(capacity, sequence),
        wavelengths(capacity),
        emission(capacity, scene.scene.emission_spectra.size(), sampler),
        throughput(capacity),
        radiance(capacity),
        eta_scale(capacity),
        media(has_media(scene) ? capacity : 0),
        vertex(capacity),
        normal(scene.lights.uses_normals() ? capacity : 0),
        groups(scene.lights.group_count()),
        group_choice(groups > 1 ? capacity * groups : 0),
        tints(scene.scene.environment ? capacity : 0),
        shadow_rays(capacity),
        shadow_radiance(capacity),
        shadows(capacity),
        by_delta_light(photopic::has_panes(scene) ? capacity : 0),
        active(capacity),
        shadowed(capacity),
        sorted(capacity),
        bucket(capacity) {}

  /// The wavelengths of a packet's paths [nm].
  PHOTOPIC_INLINE SpectrumLanes<N> lambda_of(const Packet& packet) const {
    return gather_spectra<N>([&](int i) { return &wavelengths[packet[i]].lambda; });
  }

  /// The probabilities of each group of lights at the slot's last vertex; empty where there is one group.
  std::span<float> groups_of(std::uint32_t slot) {
    if (group_choice.empty()) return {};
    return std::span(group_choice).subspan(slot * groups, groups);
  }

  /// What bounds the medium in front of the surface that was hit, or null.
  const Surface* outside_of(std::uint32_t slot, const PreparedScene& scene) const {
    return media.empty() ? nullptr : surface_of(scene, media[slot].outside());
  }

  bool has_panes() const { return !by_delta_light.empty(); }

  /// The slot's last vertex as the lights see it.
  LightReference vertex_of(std::uint32_t slot) const {
    if (normal.empty()) return {vertex[slot], {}};
    return {vertex[slot], normal[slot], std::bit_cast<std::int32_t>(normal.w(slot))};
  }

  // The path so far.
  RayArray rays;
  std::vector<Hit> hits;
  std::vector<std::uint32_t> pixel;
  StreamArray stream;
  std::vector<PathWavelengths<N>> wavelengths;
  EmissionArray<N> emission;
  std::vector<SampledSpectrum<N>> throughput;  ///< β, per wavelength
  std::vector<SampledSpectrum<N>> radiance;    ///< gathered so far [cd/m² per unit emission spectrum]
  std::vector<float> eta_scale;  ///< η² of the interfaces crossed: what roulette must not mistake for loss
  std::vector<PathMedia> media;  ///< empty where the scene has none

  /// The last vertex's position [m] (where rays start is a little off it), and the density of the direction
  /// in which the path went on from there [1/sr]; 0: it was a delta, or the camera's. Panes that it passed
  /// since are none.
  RowArray vertex;
  RowArray normal;  ///< of the last vertex, and bits of its view of the sky, where lights are chosen by them
  std::size_t groups;                  ///< of lights
  std::vector<float> group_choice;     ///< see groups_of
  std::vector<SampledTints<N>> tints;  ///< for the environment's colours

  // Light samples of this depth.
  RayArray shadow_rays;
  std::vector<SampledSpectrum<N>> shadow_radiance;  ///< arrives when the ray is not blocked
  std::vector<Shadow> shadows;
  std::vector<std::uint8_t> by_delta_light;  ///< 1 or 0; empty where the scene has no panes

  // Slots at work.
  SlotQueue active;
  SlotQueue shadowed;
  std::vector<std::uint32_t> sorted;                               ///< the active by their BSDFs
  std::vector<std::uint8_t> bucket;                                ///< of each of the active
  std::array<std::span<const std::uint32_t>, kBsdfKinds> by_kind;  ///< parts of the sorted
};

}  // namespace photopic
