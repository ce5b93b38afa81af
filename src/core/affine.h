#pragma once

#include <optional>

#include "core/math.h"

namespace photopic {

/// p ↦ x·p.x + y·p.y + z·p.z + t.
template <typename T>
struct AffineMap {
  Vec3<T> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t;

  Vec3<T> vector(Vec3<T> v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3<T> point(Vec3<T> p) const { return vector(p) + t; }
  T determinant() const { return dot(x, cross(y, z)); }

  /// Carries normals: the cofactor matrix, |det| times the inverse transpose, which lives on where there is
  /// no inverse.
  Vec3<T> normal(Vec3<T> n) const {
    const Vec3<T> image = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return determinant() < 0 ? -image : image;
  }

  friend AffineMap operator*(const AffineMap& a, const AffineMap& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.t)};
  }
};
using Affine = AffineMap<double>;
using Affinef = AffineMap<float>;

inline Affinef round_to_float(const Affine& a) {
  return {to_float(a.x), to_float(a.y), to_float(a.z), to_float(a.t)};
}

inline bool is_finite(const Affine& m) {
  return is_finite(m.x) && is_finite(m.y) && is_finite(m.z) && is_finite(m.t);
}

/// The rotation by a quaternion, which need not be normalised; nothing for zero and for what is not finite.
inline std::optional<Affine> rotation(double qx, double qy, double qz, double qw) {
  const double norm = std::hypot(std::hypot(qx, qy), std::hypot(qz, qw));
  if (!(norm > 0.0) || !std::isfinite(norm)) return std::nullopt;
  const double x = qx / norm, y = qy / norm, z = qz / norm, w = qw / norm;
  return Affine{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
                {}};
}

/// How much the map and its inverse, one after the other, magnify the rounding of coordinates: the row-sum
/// norm of |M|·|M⁻¹|, its linear parts taken by their entries' magnitudes (Bauer 1966, Skeel 1979). 1 for
/// scales along the axes, up to 3 for rotations, infinite where there is no inverse.
inline double rounding_gain(const Affine& m) {
  const double det = m.determinant();
  if (!(std::abs(det) > 0.0)) return INFINITY;
  const Vec3d rows[3] = {cross(m.y, m.z) / det, cross(m.z, m.x) / det, cross(m.x, m.y) / det};
  const auto sum = [](Vec3d v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
  const Vec3d inverse{sum(rows[0]), sum(rows[1]), sum(rows[2])};
  const auto row = [&](double a, double b, double c) {
    return std::abs(a) * inverse.x + std::abs(b) * inverse.y + std::abs(c) * inverse.z;
  };
  const double gain =
      std::max({row(m.x.x, m.y.x, m.z.x), row(m.x.y, m.y.y, m.z.y), row(m.x.z, m.y.z, m.z.z)});
  return std::isfinite(gain) ? gain : INFINITY;
}

}  // namespace photopic
