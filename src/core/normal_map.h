#pragma once

#include "core/surface_point.h"

namespace photopic {

/// The shading normal that a normal map gives a hit, unit and on the geometric normal's side. The tangent is
/// the mesh's, where it has one, else follows the texture's coordinates over the triangle (pbrt-v4, section
/// 10.1.1), made perpendicular to the interpolated normal. Where the mapped normal would turn away from a
/// viewer (in direction wo) who sees the triangle, and where the coordinates are degenerate, the interpolated
/// one stays. @param texture in tangent space @param scale on its x and y
Vec3f mapped_normal(const Geometry& geometry, const Hit& hit, const SurfacePoint& point, Vec3f wo,
                    const Texture& texture, float scale);

/// A frame whose s is that tangent and whose t is the bitangent, for surfaces with a grain; texture
/// coordinates are TEXCOORD_0. Any frame about the normal where there is no tangent.
Frame grain_frame(const Geometry& geometry, const Hit& hit, const SurfacePoint& point, const Frame& frame);

}  // namespace photopic
