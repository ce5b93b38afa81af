#pragma once

#include "core/math.h"

namespace photopic {

/// A right-handed orthonormal frame; BSDFs live in it with the normal as z.
struct Frame {
  Vec3f s, t, n;

  /// Any frame about a unit normal: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3.
  static Frame about(Vec3f n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  Vec3f to_local(Vec3f w) const { return {dot(s, w), dot(t, w), dot(n, w)}; }
  Vec3f to_world(Vec3f w) const { return s * w.x + t * w.y + n * w.z; }
};

}  // namespace photopic
