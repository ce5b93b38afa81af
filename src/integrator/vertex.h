#pragma once

#include "core/bsdf/bsdf.h"
#include "core/normal_map.h"
#include "core/prepared_scene.h"
#include "core/surface_point.h"

namespace photopic {

inline Vec3f mapped_normal(const Geometry& geometry, const Hit& hit, const SurfacePoint& point, Vec3f wo,
                           const Surface& surface) {
  return mapped_normal(geometry, hit, point, wo, surface.textures->normal, surface.textures->normal_scale);
}

/// A hit with its normal map applied.
inline SurfacePoint mapped_point(const Geometry& geometry, const Hit& hit, Vec3f wo, const Surface& surface) {
  SurfacePoint point = surface_point(geometry, hit);
  if (surface.maps_normals) point.shading_normal = mapped_normal(geometry, hit, point, wo, surface);
  return point;
}

/// The normal of a hit's clearcoat, on the triangle's front: the mesh's, or its own map's; that of the base
/// is not the coat's (KHR_materials_clearcoat).
inline Vec3f coat_normal(const Geometry& geometry, const Hit& hit, Vec3f wo, const Surface& surface) {
  const SurfacePoint point = surface_point(geometry, hit);
  const MaterialTextures& textures = *surface.textures;
  if (!textures.clearcoat_normal) return point.shading_normal;
  return mapped_normal(geometry, hit, point, wo, textures.clearcoat_normal, textures.clearcoat_normal_scale);
}

/// The same in the shading frame.
inline Vec3f coat_normal(const Geometry& geometry, const Hit& hit, Vec3f wo, const Surface& surface,
                         const Frame& frame, Vec3f geometric_normal) {
  const Vec3f n = coat_normal(geometry, hit, wo, surface);
  return frame.to_local(dot(frame.n, geometric_normal) < 0.0f ? -n : n);
}

/// @param wo in the shading frame @param throughput of the path so far: a BSDF that must choose a wavelength
/// goes by it @param coat_normal finds that of a coat, in the shading frame; asked where it has its own
template <typename Bsdf, int N, typename CoatNormal>
Bsdf make_bsdf(const ShadingMaterial<N>& material, Vec3f wo, SampledSpectrum<N> throughput,
               const CoatNormal& coat_normal) {
  if constexpr (std::is_constructible_v<Bsdf, ShadingMaterial<N>, Vec3f, SampledSpectrum<N>>) {
    return Bsdf(material, wo, throughput);
  } else {
    if constexpr (requires { Bsdf::kHasCoat; })
      if (material.surface().coat_has_normals) return Bsdf(material, wo, coat_normal());
    return Bsdf(material, wo);
  }
}

/// A vertex of a path: a hit with its frame and its BSDF at the path's wavelengths. Directions are in world
/// space.
template <int N, typename Bsdf>
struct Vertex {
  /// @param throughput of the path so far: a BSDF that must choose a wavelength goes by it
  /// @param outside what bounds the medium in front of the surface, or null
  Vertex(const PreparedScene& scene, const Hit& hit, Vec3f wo_world, SampledSpectrum<N> lambda,
         SampledSpectrum<N> throughput, const Surface* outside = nullptr)
      : material(scene.shapes[hit.shape].material),
        surface(scene.surfaces[material]),
        point(mapped_point(scene.scene.geometry, hit, wo_world, surface)),
        frame(make_frame(scene.scene.geometry, hit, wo_world)),
        wo(frame.to_local(wo_world)),
        bsdf(make_bsdf<Bsdf>(
            ShadingMaterial<N>(surface, lambda, {scene.scene.geometry, hit}, outside), wo, throughput, [&] {
              return coat_normal(scene.scene.geometry, hit, wo_world, surface, frame, point.geometric_normal);
            })) {}

  Frame make_frame(const Geometry& geometry, const Hit& hit, Vec3f wo_world) const {
    const Frame any = shading_frame(point, wo_world, Bsdf::kTwoSided);
    if constexpr (requires { Bsdf::kHasGrain; })
      if (surface.extensions->anisotropy > 0.0f) return grain_frame(geometry, hit, point, any);
    return any;
  }

  std::optional<BsdfSample<N>> sample(float u_lobe, Sample2d u) const {
    auto s = bsdf.sample(u_lobe, u);
    if (!s) return {};
    const float cos_theta = s->wi.z;
    s->wi = frame.to_world(s->wi);
    if (sides_differ(s->wi, cos_theta)) return {};
    return s;
  }

  /// Whether wi is above the triangle but below the shading normal's plane, or the other way about. Light
  /// from there would leak through the surface: Veach 1997, section 5.3. What is not a number stays to be
  /// seen.
  bool sides_differ(Vec3f wi, float cos_theta) const {
    return dot(wi, point.geometric_normal) * cos_theta * dot(frame.n, point.geometric_normal) <= 0.0f;
  }

  /// Whether w points to the back.
  bool is_inwards(Vec3f w) const { return dot(w, point.geometric_normal) < 0.0f; }

  std::uint32_t material;
  const Surface& surface;
  SurfacePoint point;
  Frame frame;
  Vec3f wo;  ///< local
  Bsdf bsdf;
};

}  // namespace photopic
