#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/lights/light.h"
#include "core/sample_sequence.h"

namespace photopic {

/// Points that light is gathered at, and the random numbers to do it with.
struct LightReferenceLanes {
  BasicLightReference<Lanes> place;
  std::array<std::span<const float>, kLanes> groups;  ///< LightSampler::group_probabilities(), or empty
  DoubleLanes u_choice;                               ///< in [0, 1), of 32 bits or more
  Sample2dLanes u;
  int count;  ///< of the lanes in use
};

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
