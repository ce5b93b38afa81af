#pragma once

#include "integrator/bsdf_packet.h"
#include "integrator/features.h"
#include "integrator/path_batch.h"
#include "integrator/vertex.h"

namespace photopic {

/// Vertices of up to 16 paths. Directions are in world space.
template <int N, typename Bsdf, Features kHas>
struct VertexPacket {
  VertexPacket(const PreparedScene& scene, const PathBatch<N>& batch, const Packet& packet)
      : point(surface_points(scene.scene.geometry, batch.hits, packet)) {
    const Geometry& geometry = scene.scene.geometry;
    if (kHas.media && !scene.touching.empty()) widen(batch, packet);
    const Vec3Lanes wo_world = -batch.rays.direction.gather_vectors(packet);
    for (int i = 0; i < packet.count; ++i) {
      const Hit& hit = batch.hits[packet[i]];
      const std::uint32_t m = scene.shapes[hit.shape].material;
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
    make_bsdfs(scene, batch, packet, wo_world);
  }

  void make_bsdfs(const PreparedScene& scene, const PathBatch<N>& batch, const Packet& packet,
                  const Vec3Lanes& wo_world) {
    const Geometry& geometry = scene.scene.geometry;
    const Vec3Lanes wo = frame.to_local(wo_world);
    const auto material_at = [&](int i) {
      const std::uint32_t slot = packet[i];
      return ShadingMaterial<N>(surface(scene, i), batch.wavelengths[slot].lambda,
                                {geometry, batch.hits[slot]},
                                kHas.media ? batch.outside_of(slot, scene) : nullptr);
    };
    const auto lambda_of = [&] { return batch.lambda_of(packet); };
    if constexpr (std::is_same_v<Bsdf, DiffuseBsdf<N>>)
      bsdfs.emplace(base_colors<N>(packet, material_at, only_surface(scene, packet), lambda_of), wo);
    else if constexpr (std::is_same_v<Bsdf, OpaqueBsdf<N>>)
      bsdfs.emplace(opaque_materials<N>(packet, material_at, only_surface(scene, packet), lambda_of,
                                        are_in_vacuum(batch, packet)),
                    wo);
    else
      bsdfs.emplace(packet, [&](int i) {
        const std::uint32_t slot = packet[i];
        return make_bsdf<Bsdf>(material_at(i), lane(wo, i), batch.throughput[slot], [&] {
          return coat_normal(geometry, batch.hits[slot], lane(wo_world, i), surface(scene, i), lane(frame, i),
                             lane(point.geometric_normal, i));
        });
      });
  }

  /// Whether no medium lies in front of the surfaces.
  bool are_in_vacuum(const PathBatch<N>& batch, const Packet& packet) const {
    if (!kHas.media || batch.media.empty()) return true;
    for (int i = 0; i < packet.count; ++i)
      if (batch.media[packet[i]].outside() != PathMedia::kVacuum) return false;
    return true;
  }

  /// By what lies in the same place.
  void widen(const PathBatch<N>& batch, const Packet& packet) {
    for (int i = 0; i < packet.count; ++i) {
      const PathMedia& media = batch.media[packet[i]];
      if (!media.is_thick()) continue;
      SurfacePoint one = lane(point, i);
      media.widen(one);
      set_lane(point, i, one);
    }
  }

  const Surface& surface(const PreparedScene& scene, int i) const {
    return scene.surfaces[material[static_cast<std::size_t>(i)]];
  }
  /// The surface on which all paths lie, as they often do when sorted, or null.
  const Surface* only_surface(const PreparedScene& scene, const Packet& packet) const {
    for (int i = 1; i < packet.count; ++i)
      if (material[static_cast<std::size_t>(i)] != material[0]) return nullptr;
    return &scene.surfaces[material[0]];
  }
  /// See Vertex::sides_differ.
  IntLanes sides_agree(Vec3Lanes wi, Lanes cos_theta) const {
    return ~(dot(wi, point.geometric_normal) * cos_theta * dot(frame.n, point.geometric_normal) <= 0.0f);
  }

  /// Which w point to the back.
  IntLanes is_inwards(Vec3Lanes w) const { return dot(w, point.geometric_normal) < 0.0f; }

  SurfacePointLanes point;
  FrameLanes frame;
  std::array<std::uint32_t, kLanes> material;
  std::optional<BsdfPacket<N, Bsdf>> bsdfs;
};

}  // namespace photopic
