#pragma once

#include <span>

#include "core/surface.h"

namespace photopic {

/// Makes the tables of those surfaces of a scene that are of rough solid glass: for the ratios of indices
/// that each can have to what is around it, air or others' media; those that would hide it do not count.
/// @param surfaces all that are used
void prepare_rough_glass(std::span<Surface* const> surfaces);

}  // namespace photopic
