#pragma once

#include <array>

#include "core/sampling.h"

namespace photopic {

/// A triangle or parallelogram as seen from a point: its solid angle, and directions uniform in it; of one
/// viewer (T float) or 16. A fan of spherical triangles about the first vertex; parts are found by half-angle
/// tangents (Peters 2021, "BRDF Importance Sampling for Polygonal Lights", section 4.1), without the
/// arccosines that fail for small ones (Arvo 1995).
template <typename T>
class BasicSphericalPolygon {
 public:
  /// @param vertices in order about the polygon, relative to the viewer [m]; of a triangle the fourth is a
  /// repetition
  /// @param volumes of the parallelepipeds that the triangles (0, 1, 2) and (0, 2, 3) span with the viewer,
  /// > 0; the second 0 for a triangle [m³]
  BasicSphericalPolygon(const std::array<Vec3<T>, 4>& vertices, const std::array<T, 2>& volumes) {
    std::array<T, 4> inverse_length;
    for (std::size_t i = 0; i < 4; ++i) {
      inverse_length[i] = 1.0f / length(vertices[i]);
      unit_[i] = vertices[i] * inverse_length[i];
    }
    for (std::size_t i = 0; i < 2; ++i) {
      // Van Oosterom & Strackee 1983; the volume keeps small angles exact, the sum those near a half turn.
      const Vec3<T> a = unit_[0], b = unit_[i + 1], c = unit_[i + 2], sum = a + b;
      Part& p = part_[i];
      p.sine = volumes[i] * inverse_length[0] * inverse_length[i + 1] * inverse_length[i + 2];
      p.cosines = dot(sum, c);
      p.one_plus_cosine = 0.5f * dot(sum, sum);
      p.solid_angle = 2.0f * angle_above(p.sine, p.one_plus_cosine + p.cosines);
    }
  }

  T solid_angle() const { return part_[0].solid_angle + part_[1].solid_angle; }  ///< [sr]

  struct Sample {
    Vec3<T> direction;             ///< unit; density 1/solid_angle()
    decltype(T{} < T{}) in_first;  ///< whether it goes through the first triangle
  };
  Sample sample(BasicSample2d<T> u) const {
    // Which triangle, and the end of the great circle that cuts the share u.x of it off.
    const T all = u.x * solid_angle();
    const auto second = all >= part_[0].solid_angle;
    const auto pick = [&](T Part::*of) { return select(second, part_[1].*of, part_[0].*of); };
    const T solid_angle = pick(&Part::solid_angle), cosines = pick(&Part::cosines);
    const T angle = min(all - select(second, part_[0].solid_angle, T{}), solid_angle);
    const auto half = sin_cos_two_pi(angle * (0.25f / kPi));
    const Vec3<T> a = unit_[0], b = select(second, unit_[2], unit_[1]),
                  c = select(second, unit_[3], unit_[2]);
    const Vec3<T> middle = b * (pick(&Part::sine) * half.cos - cosines * half.sin) +
                           c * (pick(&Part::one_plus_cosine) * half.sin);
    const Vec3<T> end = middle * (2.0f * dot(b, middle) / dot(middle, middle)) - b;

    // The point on the arc from the first vertex to it, uniform in the cosine.
    const Vec3<T> chord = end - a;
    const T drop = u.y * 0.5f * dot(chord, chord);  // 1 − cos
    const Vec3<T> across = chord - a * dot(chord, a);
    const T across2 = dot(across, across);
    const Vec3<T> way = a * (1.0f - drop) + across * sqrt(drop * (2.0f - drop) / across2);
    return {select(across2 > 0.0f, way * (1.0f / length(way)), a), all < part_[0].solid_angle};
  }

 private:
  /// Of the triangle of unit vectors a, b, c: det(a, b, c), a·c + b·c and 1 + a·b.
  struct Part {
    T sine, cosines, one_plus_cosine, solid_angle;
  };
  std::array<Vec3<T>, 4> unit_;
  std::array<Part, 2> part_;
};

}  // namespace photopic
