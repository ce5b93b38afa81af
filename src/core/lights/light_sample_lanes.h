#pragma once

#include <optional>

#include "core/lights/light.h"

namespace photopic {

/// LightSample's fields for the paths of a packet.
struct LightSampleLanes {
  IntLanes reached{};  ///< mask: the light chosen reaches the point; else the lane's fields mean nothing
  Vec3Lanes direction{}, end{};
  Lanes distance{}, pdf{}, radiance{};
  IntLanes delta{}, environment{};  ///< masks
  IntLanes spectrum{};
  UintLanes material{}, triangle{};

  void set(int i, const std::optional<LightSample>& s) {
    reached[i] = s ? -1 : 0;
    if (!s) return;
    set_lane(direction, i, s->direction);
    set_lane(end, i, s->end);
    distance[i] = s->distance, pdf[i] = s->pdf, radiance[i] = s->radiance;
    delta[i] = s->delta ? -1 : 0, environment[i] = s->environment ? -1 : 0;
    spectrum[i] = s->spectrum, material[i] = s->material, triangle[i] = s->triangle;
  }
};

}  // namespace photopic
