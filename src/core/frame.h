#pragma once

#include "core/math.h"

namespace photopic {

/// A right-handed orthonormal frame, of one path (T float) or 16; BSDFs live in it with the normal as z.
template <typename T>
struct BasicFrame {
  Vec3<T> s, t, n;

  /// Any frame about a unit normal: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3.
  static BasicFrame about(Vec3<T> n) {
    const T sign = copysign(T{} + 1.0f, n.z);
    const T a = -1.0f / (sign + n.z);
    const T b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  Vec3<T> to_local(Vec3<T> w) const { return {dot(s, w), dot(t, w), dot(n, w)}; }
  Vec3<T> to_world(Vec3<T> w) const { return s * w.x + t * w.y + n * w.z; }
};
using Frame = BasicFrame<float>;
using FrameLanes = BasicFrame<Lanes>;

inline Frame lane(const FrameLanes& f, int i) {
  return {lane(f.s, i), lane(f.t, i), lane(f.n, i)};
}
inline void set_lane(FrameLanes& f, int i, const Frame& frame) {
  set_lane(f.s, i, frame.s), set_lane(f.t, i, frame.t), set_lane(f.n, i, frame.n);
}

}  // namespace photopic
