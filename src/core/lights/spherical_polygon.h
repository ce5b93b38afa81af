#pragma once

#include <array>

#include "core/sampling.h"
#include "spectral/float_vectors.h"

namespace photopic {

/// A triangle or parallelogram as seen from a point: its solid angle, and directions uniform in it. A fan of
/// spherical triangles about the first vertex; parts are found by half-angle tangents (Peters 2021, "BRDF
/// Importance Sampling for Polygonal Lights", section 4.1), without the arccosines that fail for small ones
/// (Arvo 1995).
class SphericalPolygon {
 public:
  /// @param vertices 3 or 4, in order about the polygon, relative to the viewer [m]; of a triangle the fourth
  /// is a repetition
  /// @param volume of the parallelepiped that each triangle of the fan spans with the viewer, > 0 [m³]
  SphericalPolygon(const std::array<Vec3f, 4>& vertices, int count, float volume) : parts_(count - 2) {
    Float4 x, y, z, inverse_length;
    for (int i = 0; i < 4; ++i) {
      const Vec3f v = vertices[static_cast<std::size_t>(i)];
      x[i] = v.x, y[i] = v.y, z[i] = v.z;
    }
    const Float4 squared = x * x + y * y + z * z;
    for (int i = 0; i < 4; ++i) inverse_length[i] = std::sqrt(squared[i]);
    inverse_length = 1.0f / inverse_length;
    x *= inverse_length, y *= inverse_length, z *= inverse_length;
    for (int i = 0; i < 4; ++i) unit_[static_cast<std::size_t>(i)] = {x[i], y[i], z[i]};
    for (int i = 0; i < parts_; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vec3f a = unit_[0], b = unit_[k + 1], c = unit_[k + 2];
      // Van Oosterom & Strackee 1983; the volume keeps small angles exact, the sum those near a half turn.
      Part& p = part_[k];
      p.sine = volume * inverse_length[0] * inverse_length[i + 1] * inverse_length[i + 2];
      const Vec3f sum = a + b;
      p.cosines = dot(sum, c);
      p.one_plus_cosine = 0.5f * dot(sum, sum);
      p.solid_angle = 2.0f * angle_above(p.sine, p.one_plus_cosine + p.cosines);
      solid_angle_ += p.solid_angle;
    }
  }

  float solid_angle() const { return solid_angle_; }  ///< [sr]

  struct Sample {
    Vec3f direction;  ///< unit; density 1/solid_angle()
    int part;         ///< triangle of the fan that it goes through: (0, 1, 2), then (0, 2, 3)
  };
  Sample sample(Sample2d u) const {
    // Which triangle, and the end of the great circle that cuts the share u.x of it off.
    float angle = u.x * solid_angle_;
    const int i = parts_ == 2 && angle >= part_[0].solid_angle ? 1 : 0;
    if (i == 1) angle -= part_[0].solid_angle;
    const Part& p = part_[i];
    const auto half = sin_cos_two_pi(std::clamp(angle, 0.0f, p.solid_angle) * (0.25f / kPi));
    const Vec3f a = unit_[0], b = unit_[i + 1];
    const Vec3f middle =
        b * (p.sine * half.cos - p.cosines * half.sin) + unit_[i + 2] * (p.one_plus_cosine * half.sin);
    const Vec3f end = middle * (2.0f * dot(b, middle) / dot(middle, middle)) - b;

    // The point on the arc from the first vertex to it, uniform in the cosine.
    const Vec3f chord = end - a;
    const float drop = u.y * 0.5f * dot(chord, chord);  // 1 − cos
    const Vec3f across = chord - a * dot(chord, a);
    const float across2 = dot(across, across);
    if (!(across2 > 0.0f)) return {a, i};
    const Vec3f way = a * (1.0f - drop) + across * std::sqrt(drop * (2.0f - drop) / across2);
    return {way * (1.0f / length(way)), i};
  }

 private:
  /// Of the triangle of unit vectors a, b, c: det(a, b, c), a·c + b·c and 1 + a·b.
  struct Part {
    float sine, cosines, one_plus_cosine, solid_angle;
  };
  std::array<Vec3f, 4> unit_;
  std::array<Part, 2> part_;
  int parts_;
  float solid_angle_ = 0.0f;
};

}  // namespace photopic
