#pragma once

#include "core/surface_point.h"

namespace photopic {

/// The shading normal that a normal map gives a hit, unit and on the geometric normal's side. The tangent is
/// the mesh's, where it has one, else follows the texture's coordinates over the triangle (pbrt-v4, section
/// 10.1.1), made perpendicular to the interpolated normal. Where the mapped normal would turn away from a
/// viewer (in direction wo) who sees the triangle, and where the coordinates are degenerate, the interpolated
/// one stays.
Vec3f mapped_normal(const Geometry& geometry, const Hit& hit, const SurfacePoint& point, Vec3f wo,
                    const MaterialTextures& textures);

}  // namespace photopic
