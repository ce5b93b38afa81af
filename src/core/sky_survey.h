#pragma once

#include <span>

#include "core/accel.h"
#include "core/lights/sky_views.h"
#include "core/scene.h"
#include "core/surface.h"

namespace photopic {

/// Looks at the sky from places that paths from the camera reach; the same scene always gives the same.
/// @param surfaces of its materials @return nothing where no choice depends on it
SkyViews survey_sky(const Scene& scene, const Accel& accel, std::span<const Surface> surfaces);

}  // namespace photopic
