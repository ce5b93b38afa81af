#pragma once

#include "core/scene.h"

namespace photopic::test {

/// Makes the scene's last shape a prototype, its vertices relative to their box's middle, and puts an
/// instance at each place. (The shape leaves its own place in the world.)
Scene with_instances(Scene scene, const std::vector<Affine>& places);

/// The same picture without instances: every one baked into the world in double precision.
Scene baked(const Scene& scene);

/// Scale, then turn about an axis, then move.
Affine placement(Vec3d scale, Vec3d axis, double radians, Vec3d move);

}  // namespace photopic::test
