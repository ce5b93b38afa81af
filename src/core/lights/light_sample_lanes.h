#pragma once

#include <array>
#include <optional>

#include "core/lights/light.h"

namespace photopic {

/// Light samples of the paths of a packet; what is computed with in lanes stands in lanes.
struct LightSampleLanes {
  std::array<std::optional<LightSample>, kLanes> sample{};
  Vec3Lanes direction{}, end{};
  Lanes pdf{}, radiance{};

  void set(int i, const std::optional<LightSample>& s) {
    sample[static_cast<std::size_t>(i)] = s;
    if (!s) return;
    set_lane(direction, i, s->direction);
    set_lane(end, i, s->end);
    pdf[i] = s->pdf, radiance[i] = s->radiance;
  }
  const std::optional<LightSample>& operator[](int i) const { return sample[static_cast<std::size_t>(i)]; }
};

}  // namespace photopic
