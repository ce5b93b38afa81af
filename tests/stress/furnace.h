#pragma once

#include "support/scene_builder.h"
#include "support/standard_scenes.h"

namespace photopic::test {

/// A box of a material in a room that shines with 3 cd/m² (or `luminance`): what loses nothing is not seen.
inline SceneBuilder furnace(const Material& m, double luminance = 3.0) {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, luminance), true);
  b.box({-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, b.material(m));
  b.camera({0.5, -1.9, 0.7}, {0, 0, 0}, 50, 8, 8);
  return b;
}

}  // namespace photopic::test
