#pragma once

#include "core/affine.h"

namespace photopic {

/// The lower and the higher of each coordinate.
template <typename T>
Vec3<T> lower(Vec3<T> a, Vec3<T> b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <typename T>
Vec3<T> upper(Vec3<T> a, Vec3<T> b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// An axis-aligned box; empty at first.
template <typename T>
struct Box {
  Vec3<T> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

  void add(Vec3<T> p) { low = lower(low, p), high = upper(high, p); }
  void add(const Box& b) { low = lower(low, b.low), high = upper(high, b.high); }
  void grow(T d) {
    low = low - Vec3<T>{d, d, d};
    high = high + Vec3<T>{d, d, d};
  }
  bool is_empty() const { return !(low.x <= high.x); }
  Vec3<T> middle() const { return is_empty() ? Vec3<T>{} : (low + high) * T(0.5); }
  /// @param i from 0 to 7, a bit for each axis
  Vec3<T> corner(int i) const {
    return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
  }
  bool overlaps(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
           low.z <= b.high.z && b.low.z <= high.z;
  }
};
using Boxf = Box<float>;
using Boxd = Box<double>;

/// The box about a box that is mapped; none for none.
template <typename T>
Box<T> image_of(const Box<T>& box, const AffineMap<T>& map) {
  Box<T> image;
  for (int i = 0; i < 8 && !box.is_empty(); ++i) image.add(map.point(box.corner(i)));
  return image;
}

}  // namespace photopic
