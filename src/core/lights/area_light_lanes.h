#pragma once

#include <array>

#include "core/lights/area_light.h"
#include "core/lights/light_sample_lanes.h"

namespace photopic {

/// Area lights, one a lane.
struct AreaLightLanes {
  explicit AreaLightLanes(const AreaLight& in_all);
  explicit AreaLightLanes(const std::array<const AreaLight*, kLanes>& lights);

  /// A point of each, where it can be seen from there; what it emits is for the caller to fill in.
  void sample(const Vec3Lanes& from, const Sample2dLanes& u, LightSampleLanes& samples) const;

  Vec3Lanes vertex, edge1, edge2, normal;
  Lanes area, error;
  UintLanes triangle, material;
  IntLanes parallelogram, double_sided;  ///< masks
};

}  // namespace photopic
