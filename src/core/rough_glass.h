#pragma once

#include <span>

#include "core/surface.h"

namespace photopic {

/// Makes the table that a surface needs if it is of rough solid glass: for the ratios of indices that it can
/// have to what is around it, air or others' media.
/// @param others that may enclose media; those that would hide the surface do not count
void prepare_rough_glass(Surface& glass, std::span<const Surface> others);

/// The same for all surfaces of a scene. Where there is but one medium they have theirs already.
void prepare_rough_glass(std::span<Surface> surfaces);

}  // namespace photopic
