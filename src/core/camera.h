#pragma once

#include "core/math.h"

namespace photopic {

/// A ray with a unit direction; t is in metres along it.
struct Ray {
  Vec3f origin;
  Vec3f direction;
};

/// glTF's perspective camera: looks down −z, +y up, square pixels.
struct Camera {
  Vec3f position;                                    ///< relative to Scene::origin [m]
  Vec3f right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};  ///< orthonormal
  float tan_half_yfov = 0.5f;
  int width = 0, height = 0;  ///< [pixels]

  /// The ray through film position (x, y) in pixels, (0, 0) the top left corner of the film.
  Ray ray(float x, float y) const {
    const float scale = 2.0f * tan_half_yfov / static_cast<float>(height);
    const float dx = (x - 0.5f * static_cast<float>(width)) * scale;
    const float dy = (0.5f * static_cast<float>(height) - y) * scale;
    return {position, normalize(right * dx + up * dy - back)};
  }
};

}  // namespace photopic
