#pragma once

#include <array>

#include "core/scene.h"

namespace photopic::test {

/// Puts a scene together in code. Coordinates are doubles in metres until build() rounds them.
class SceneBuilder {
 public:
  /// @return the material's index
  std::uint32_t material(const Material& m);
  /// A material that only emits, from its front (or both sides), with a luminance [cd/m²].
  std::uint32_t lamp(const Spectrum& spectrum, double luminance, bool double_sided = false);
  /// @return the index of the spectrum, scaled to unit luminance
  int emission(const Spectrum& spectrum);

  /// The front is where the corners run counter-clockwise.
  void triangle(Vec3d a, Vec3d b, Vec3d c, std::uint32_t material);
  void quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, std::uint32_t material);
  /// A horizontal rectangle about `centre`, z up, facing up or down.
  void floor(Vec3d centre, double half_x, double half_y, std::uint32_t material);
  void ceiling(Vec3d centre, double half_x, double half_y, std::uint32_t material);
  /// An axis-aligned box whose fronts look out, or in.
  void box(Vec3d low, Vec3d high, std::uint32_t material, bool inwards = false);
  /// An icosahedron split `levels` times on the sphere, its normals smooth or the facets' own.
  void sphere(Vec3d centre, double radius, int levels, std::uint32_t material, bool smooth = true);

  void camera(Vec3d position, Vec3d target, double yfov_degrees, int width, int height);

  /// Everything p becomes p·scale + offset, the camera too.
  SceneBuilder& place(double scale, Vec3d offset = {});

  /// Turns everything about an axis through zero.
  SceneBuilder& turn(Vec3d axis, double radians);

  /// Rounds coordinates relative to the origin.
  Scene build(Vec3d origin = {}) const;

 private:
  std::uint32_t vertex(Vec3d p, Vec3d normal = {});
  void begin_shape(std::uint32_t material);
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  Scene scene_;
  std::vector<Vec3d> positions_;
  Vec3d camera_;
};

/// Materials by their essentials.
Material diffuse(const Spectrum& albedo);
Material metal(const Spectrum& base, float roughness);
Material plastic(const Spectrum& base, float roughness, float ior = 1.5f);
Material solid_glass(float ior, float roughness);
Material thin_glass(float ior, float roughness);

}  // namespace photopic::test
