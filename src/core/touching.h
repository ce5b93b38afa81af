#pragma once

#include <span>
#include <vector>

#include "core/scene.h"
#include "core/surface.h"

namespace photopic {

/// Which triangles of solids lie, over some of their area, so close to another surface that rounding may not
/// tell which of the two a ray meets first, or whether one that starts beside the first starts beyond the
/// second; and those other triangles. Neighbours that share no more than an edge or a corner do not count.
/// A prototype's triangle is marked where it touches in one of the instances.
/// @return for each of geometry.triangles the larger bound on rounding, its own or that of what touches it
/// [m], or 0; empty where nothing touches
std::vector<float> touching_triangles(const Geometry& geometry, std::span<const Surface> surfaces);

/// Whether some triangle of a shape does. @param touching as touching_triangles gives them
bool touches(const Shape& shape, std::span<const float> touching);

/// Whether a shape is a pane that shadow rays may pass: on solid glass it would be a surface of that.
bool is_free_pane(const Shape& shape, const Surface& surface, std::span<const float> touching);

}  // namespace photopic
