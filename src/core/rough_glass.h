#pragma once

#include <span>
#include <vector>

#include "core/surface.h"

namespace photopic {

/// Makes the tables of those surfaces of a scene that are of rough solid glass: for the ratios of indices
/// that each can have to what is around it, air or others' media; those that would hide it, and those whose
/// boxes lie apart from its own, do not count. (Media that leak, through open meshes or cut-outs, may bring
/// others: then the table's nearest ratio serves, or where there is no table further bounces are left out.)
/// Glasses that need the same table share one.
/// @param used which surfaces are seen @param geometry where they are
void prepare_rough_glass(const std::vector<bool>& used, std::span<Surface> surfaces,
                         const Geometry& geometry);

}  // namespace photopic
