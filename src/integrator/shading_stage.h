#pragma once

#include "integrator/features.h"
#include "integrator/stage_watch.h"
#include "integrator/vertex_packet.h"

namespace photopic {

/// The stage between two flights: at each path's vertex it samples a light and the direction in which the
/// path goes on. 16 paths with one kind of BSDF are taken at a time.
template <int N, Features kHas>
class ShadingStage {
 public:
  explicit ShadingStage(const PreparedScene& scene) : scene_(scene) {}

  /// Takes the slots of batch.by_kind; leaves shadow rays in batch.shadowed, paths that go on in
  /// batch.active.
  /// @return how many of those were left with one wavelength by dispersion
  std::uint64_t shade(PathBatch<N>& batch, int depth, StageWatch* watch);

 private:
  template <typename Bsdf>
  std::uint64_t shade(PathBatch<N>& batch, BsdfKind kind, int depth);
  std::span<const float> weigh_groups(PathBatch<N>& batch, std::uint32_t slot,
                                      const LightSampler::GroupShares& shares, int lane) const;
  SampledSpectrum<N> lamp_tint(const PathBatch<N>& batch, std::uint32_t slot, std::uint32_t material,
                               std::uint32_t triangle, Vec3f position) const;
  template <typename Bsdf>
  LightSampleLanes choose_lights(PathBatch<N>& batch, const Packet& packet, int depth,
                                 const SampleStreamLanes& stream, const VertexPacket<N, Bsdf, kHas>& vertices,
                                 IntLanes wanted) const;
  template <typename Bsdf>
  void sample_lights(PathBatch<N>& batch, const Packet& packet, int depth, const SampleStreamLanes& stream,
                     const VertexPacket<N, Bsdf, kHas>& vertices, IntLanes wanted);
  template <typename Bsdf>
  std::uint64_t sample_directions(PathBatch<N>& batch, const Packet& packet, int depth,
                                  const SampleStreamLanes& stream,
                                  const VertexPacket<N, Bsdf, kHas>& vertices);

  bool passes_pane(const PathBatch<N>& batch, std::uint32_t slot, bool straight) const;

  const PreparedScene& scene_;
};

}  // namespace photopic
