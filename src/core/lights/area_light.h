#pragma once

#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/scene.h"
#include "core/surface.h"
#include "core/surface_point.h"

namespace photopic {

/// A glowing triangle, or two that make a parallelogram. Sampled uniformly by solid angle where it looks
/// large, by area where it is so far that both are nearly the same. A line of memory: of many lights, each
/// choice waits for one.
struct alignas(64) AreaLight {
  Vec3f vertex, edge1, edge2;  ///< [m], relative to Scene::origin; drawn towards the middle a little: see
                               ///< shrink_to_middle
  Vec3f normal;                ///< of the front, unit
  float area;                  ///< [m²]
  float error;                 ///< bound on a point's distance from its triangle's plane [m]
  std::uint32_t triangle;      ///< its first
  std::uint32_t material : 30;
  bool parallelogram : 1;  ///< else a triangle; the half on edge1 is then the second triangle
  bool double_sided : 1;

  /// The density with which AreaLightLanes samples [1/sr] the direction of a point of it. @param distance to
  /// it [m]
  float pdf(Vec3f from, float distance) const;
};
static_assert(sizeof(AreaLight) == 64);

/// A scene's area lights, and which of them a triangle belongs to.
class AreaLights {
 public:
  /// @param surfaces of the scene's materials
  AreaLights(const Scene& scene, std::span<const Surface> surfaces);

  const std::vector<AreaLight>& list() const { return lights_; }

  /// What a light is chosen by: with what varies over it, as far as a few points tell.
  float mean_luminance(std::uint32_t light) const { return mean_luminance_[light]; }  ///< [cd/m²]
  double power(std::uint32_t light) const;                                            ///< luminous flux [lm]

  /// What a material's lights emit.
  struct Emission {
    float luminance;  ///< before what varies over the surface [cd/m²]
    int spectrum;     ///< index into Scene::emission_spectra
  };
  const Emission& emission(const AreaLight& light) const { return emissions_[light.material]; }

  /// @return kNoLight for a triangle without area
  std::uint32_t light_of(std::uint32_t shape, std::uint32_t triangle) const {
    return light_of_triangle_[triangle - offset_of_shape_[shape]];
  }

 private:
  std::vector<AreaLight> lights_;
  std::vector<float> mean_luminance_;             ///< of each light
  std::vector<Emission> emissions_;               ///< of each material
  std::vector<std::uint32_t> offset_of_shape_;    ///< its first triangle less its place in light_of_triangle_
  std::vector<std::uint32_t> light_of_triangle_;  ///< of the triangles of shapes that emit
};

}  // namespace photopic
