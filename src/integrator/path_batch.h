#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/accel.h"
#include "core/bsdf.h"
#include "core/prepared_scene.h"
#include "integrator/media.h"
#include "integrator/path_start.h"
#include "spectral/rgb_light.h"

namespace photopic {

/// The sample streams of many paths.
class StreamArray {
 public:
  StreamArray(std::size_t size, Sequence sequence)
      : sequence_(sequence), seed_(size), index_reversed_(size) {}
  SampleStream operator[](std::size_t i) const { return {sequence_, seed_[i], index_reversed_[i]}; }
  void scatter(const Packet& p, const SampleStreamLanes& streams) {
    photopic::scatter(seed_.data(), p, streams.seed());
    photopic::scatter(index_reversed_.data(), p, streams.index_reversed());
  }
  SampleStreamLanes gather(const Packet& p) const {
    return {sequence_, photopic::gather(seed_.data(), p), photopic::gather(index_reversed_.data(), p)};
  }

 private:
  Sequence sequence_;
  std::vector<std::uint32_t> seed_, index_reversed_;
};

/// Drops the slots that do not `stay`. Which those are cannot be foretold, so there is no branch for each.
template <typename Stays>
void keep_if(std::vector<std::uint32_t>& slots, const Stays& stays) {
  std::size_t kept = 0;
  for (const std::uint32_t slot : slots) {
    slots[kept] = slot;
    kept += stays(slot) ? 1 : 0;
  }
  slots.resize(kept);
}

/// The state of many paths as structure of arrays, an entry a slot. Slots stay; queues of slot numbers shrink
/// as paths end.
template <int N>
struct PathBatch {
  /// What a scene does not have is not stored.
  PathBatch(std::size_t capacity, Sequence sequence, const PreparedScene& scene)
      : rays(capacity),
        hits(capacity),
        pixel(capacity),
        stream(capacity, sequence),
        sampled(capacity),
        wavelengths(capacity),
        emission(capacity * scene.scene.emission_spectra.size()),
        throughput(capacity),
        radiance(capacity),
        bsdf_pdf(capacity),
        eta_scale(capacity),
        media(has_media(scene) ? capacity : 0),
        vertex(capacity),
        normal(scene.lights.uses_normals() ? capacity : 0),
        spectrum_choice(scene.lights.several_spectra() ? emission.size() : 0),
        tints(scene.scene.environment ? capacity : 0),
        shadow_rays(capacity),
        shadow_radiance(capacity),
        blocked(capacity),
        emission_count_(scene.scene.emission_spectra.size()) {
    active.reserve(capacity);
    sorted.reserve(capacity);
    shadowed.reserve(capacity);
    for (auto& queue : by_kind) queue.reserve(capacity);
  }

  /// Emission spectrum k at the slot's wavelengths.
  SampledSpectrum<N>& emission_of(std::uint32_t slot, int k) {
    return emission[slot * emission_count_ + static_cast<std::size_t>(k)];
  }

  /// Emission spectra at the wavelengths of a packet's paths, one for each.
  SpectrumLanes<N> emissions_of(const Packet& packet, IntLanes spectra) const {
    LaneSpectra<N> values;
    for (int i = 0; i < kLanes; ++i)
      values[static_cast<std::size_t>(i)] =
          emission[packet[i] * emission_count_ + static_cast<std::size_t>(spectra[i])];
    return to_lanes<N>(values);
  }

  std::size_t emission_count() const { return emission_count_; }
  /// All of them.
  std::span<SampledSpectrum<N>> emissions_of(std::uint32_t slot) {
    return std::span(emission).subspan(slot * emission_count_, emission_count_);
  }

  /// The probabilities of each spectrum's lights at the slot's last vertex; empty where there is one
  /// spectrum.
  std::span<float> spectra_of(std::uint32_t slot) {
    if (spectrum_choice.empty()) return {};
    return std::span(spectrum_choice).subspan(slot * emission_count_, emission_count_);
  }

  /// What bounds the medium in front of the surface that was hit, or null.
  const Surface* outside_of(std::uint32_t slot, const PreparedScene& scene) const {
    return media.empty() ? nullptr : surface_of(scene, media[slot].outside());
  }

  /// The slot's last vertex as the lights see it.
  LightReference vertex_of(std::uint32_t slot) const {
    return {vertex[slot], normal.x.empty() ? Vec3f{} : normal[slot]};
  }

  // The path so far.
  RayArray rays;
  std::vector<Hit> hits;
  std::vector<std::uint32_t> pixel;
  StreamArray stream;
  std::vector<SampledWavelengths<N>> sampled;
  std::vector<PathWavelengths<N>> wavelengths;
  std::vector<SampledSpectrum<N>> emission;
  std::vector<SampledSpectrum<N>> throughput;  ///< β, per wavelength
  std::vector<SampledSpectrum<N>> radiance;    ///< gathered so far [cd/m² per unit emission spectrum]
  std::vector<float> bsdf_pdf;   ///< of the last direction [1/sr]; 0: it was a delta, or the camera's
  std::vector<float> eta_scale;  ///< η² of the interfaces crossed: what roulette must not mistake for loss
  std::vector<PathMedia> media;  ///< empty where the scene has none

  Vec3Array vertex;                    ///< the last one's position; where rays start is a little off it
  Vec3Array normal;                    ///< of the last vertex, where lights are chosen by it
  std::vector<float> spectrum_choice;  ///< see spectra_of
  std::vector<SampledTints<N>> tints;  ///< for the environment's colours

  // Light samples of this depth.
  RayArray shadow_rays;
  std::vector<SampledSpectrum<N>> shadow_radiance;  ///< arrives when the ray is not blocked
  std::vector<std::uint8_t> blocked;

  // Slots at work.
  std::vector<std::uint32_t> active;
  std::vector<std::uint32_t> sorted;  ///< the active by material
  std::vector<std::uint32_t> shadowed;
  std::vector<std::uint32_t> pane_shadowed;  ///< of those, whose lights are found by shadow rays alone
  std::array<std::vector<std::uint32_t>, kBsdfKinds> by_kind;

 private:
  std::size_t emission_count_;
};

}  // namespace photopic
