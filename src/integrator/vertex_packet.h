#pragma once

#include "integrator/features.h"
#include "integrator/path_batch.h"
#include "integrator/vertex.h"

namespace photopic {

/// Where up to 16 paths go on: BsdfSample's fields, directions in the shading frame.
template <int N>
struct DirectionSamples {
  Vec3Lanes wi{};
  Lanes pdf{}, eta = Lanes{} + 1.0f;  ///< pdf is 0 of a delta
  IntLanes found{}, split{};          ///< masks
  std::array<SampledSpectrum<N>, kLanes> weight;

  void set(int i, const std::optional<BsdfSample<N>>& sample) {
    if (!sample) return;
    set_lane(wi, i, sample->wi);
    pdf[i] = sample->delta ? 0.0f : sample->pdf, eta[i] = sample->eta;
    found[i] = -1, split[i] = sample->split ? -1 : 0;
    weight[static_cast<std::size_t>(i)] = sample->weight;
  }
};

/// Vertices of up to 16 paths: what is geometry is done for all lanes at once, BSDFs one by one. Directions
/// are in world space.
template <int N, typename Bsdf, Features kHas>
struct VertexPacket {
  VertexPacket(const PreparedScene& scene, const PathBatch<N>& batch, const Packet& packet)
      : point(surface_points(scene.scene.geometry, batch.hits, packet)) {
    const Geometry& geometry = scene.scene.geometry;
    if (kHas.media && !scene.touching.empty()) widen(batch, packet);
    const Vec3Lanes wo_world = -batch.rays.direction.gather(packet);
    for (int i = 0; i < packet.count; ++i) {
      const Hit& hit = batch.hits[packet[i]];
      const std::uint32_t m = geometry.shapes[hit.shape].material;
      material[static_cast<std::size_t>(i)] = m;
      if (kHas.textures && scene.surfaces[m].maps_normals)
        set_lane(point.shading_normal, i,
                 mapped_normal(geometry, hit, lane(point, i), lane(wo_world, i), scene.surfaces[m]));
    }
    frame = shading_frame(point, wo_world, Bsdf::kTwoSided);
    if constexpr (requires { Bsdf::kHasGrain; }) {
      for (int i = 0; i < packet.count; ++i)
        if (surface(scene, i).extensions->anisotropy > 0.0f)
          set_lane(frame, i, grain_frame(geometry, batch.hits[packet[i]], lane(point, i), lane(frame, i)));
    }
    const Vec3Lanes wo = frame.to_local(wo_world);
    for (int i = 0; i < packet.count; ++i) {
      const std::uint32_t slot = packet[i];
      const ShadingMaterial<N> at_hit(surface(scene, i), batch.wavelengths[slot].lambda,
                                      {geometry, batch.hits[slot]},
                                      kHas.media ? batch.outside_of(slot, scene) : nullptr);
      bsdf[static_cast<std::size_t>(i)].emplace(
          make_bsdf<Bsdf>(at_hit, lane(wo, i), batch.throughput[slot], [&] {
            return coat_normal(geometry, batch.hits[slot], lane(wo_world, i), surface(scene, i),
                               lane(frame, i), lane(point.geometric_normal, i));
          }));
    }
  }

  /// By what lies in the same place.
  void widen(const PathBatch<N>& batch, const Packet& packet) {
    for (int i = 0; i < packet.count; ++i) {
      SurfacePoint one = lane(point, i);
      batch.media[packet[i]].widen(one);
      set_lane(point, i, one);
    }
  }

  const Surface& surface(const PreparedScene& scene, int i) const {
    return scene.surfaces[material[static_cast<std::size_t>(i)]];
  }
  const Bsdf& bsdf_of(int i) const { return *bsdf[static_cast<std::size_t>(i)]; }

  /// Where each path goes on, as its BSDF draws it.
  DirectionSamples<N> sample(const Packet& packet, Lanes u_lobe, const Sample2dLanes& u) const {
    DirectionSamples<N> samples;
    if constexpr (std::is_same_v<Bsdf, DiffuseBsdf<N>>) {
      samples.wi = sample_cosine_hemisphere(u);
      samples.pdf = cosine_hemisphere_pdf(samples.wi.z);
      samples.found = samples.wi.z > 0.0f;
      for (int i = 0; i < packet.count; ++i) samples.weight[static_cast<std::size_t>(i)] = bsdf_of(i).albedo;
    } else {
      for (int i = 0; i < packet.count; ++i) samples.set(i, bsdf_of(i).sample(u_lobe[i], lane(u, i)));
    }
    return samples;
  }

  /// See Vertex::sides_agree.
  IntLanes sides_agree(Vec3Lanes wi, Lanes cos_theta) const {
    return dot(wi, point.geometric_normal) * cos_theta * dot(frame.n, point.geometric_normal) > 0.0f;
  }

  /// Which w point to the back.
  IntLanes is_inwards(Vec3Lanes w) const { return dot(w, point.geometric_normal) < 0.0f; }

  SurfacePointLanes point;
  FrameLanes frame;
  std::array<std::uint32_t, kLanes> material;
  std::array<std::optional<Bsdf>, kLanes> bsdf;
};

}  // namespace photopic
