#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/sampling.h"
#include "core/scene.h"

namespace photopic {

/// A point of a lamp, chosen for next-event estimation.
struct LightSample {
  Vec3f point;
  Vec3f normal;            ///< of the emitting triangle's front, unit
  float pdf_area;          ///< of the point among all lamps' surfaces [1/m²]
  std::uint32_t material;  ///< the emitter's
  std::uint32_t triangle;  ///< index into Geometry::triangles
  Sample2d uv;             ///< barycentric coordinates of its second and third vertex
  float error;             ///< bound on the point's distance from its triangle's plane [m]

  /// Where a shadow ray may end that comes from direction w.
  Vec3f leave(Vec3f w) const { return point + normal * (dot(normal, w) < 0.0f ? -error : error); }
};

/// Chooses a triangle by its power and a point uniformly on it. With luminance L per side, the density over
/// all lamps is then proportional to L alone, so it is known at any hit without asking which triangle it was.
class LightSampler {
 public:
  explicit LightSampler(const Scene& scene);

  bool empty() const { return triangles_.empty(); }
  LightSample sample(double u_choice, Sample2d u) const;

  /// The density with which sample() gives a point of a surface of this material [1/m²].
  float pdf_area(std::uint32_t material) const { return pdf_of_material_[material]; }

  /// Emitted power, up to π, of all triangles with this emission spectrum [cd].
  const std::vector<double>& power_of_spectrum() const { return power_of_spectrum_; }

 private:
  struct Triangle {
    Vec3f vertex, edge1, edge2, normal;
    std::uint32_t material, index;
    float error;
  };
  std::vector<Triangle> triangles_;
  /// Walker's alias table.
  struct Bin {
    double keep;
    std::uint32_t alias;
  };
  std::vector<Bin> bins_;
  std::vector<float> pdf_of_material_;
  std::vector<double> power_of_spectrum_;
};

}  // namespace photopic
