#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/accel.h"
#include "core/lights/light_sampler.h"
#include "core/quads.h"
#include "core/scene.h"
#include "core/surface.h"

namespace photopic {

/// Integrates the albedo tables that surfaces need, each once.
/// @param used which surfaces are seen; the others get no table @param geometry where they are
void prepare_albedos(const std::vector<bool>& used, std::span<Surface> surfaces,
                     const Geometry& geometry = {});

/// What is asked of every hit, in a few bytes a shape: surfaces are large, and seldom near.
struct ShapeTraits {
  std::uint32_t material;
  BsdfKind opaque_kind;
  bool scatters : 1, transmits : 1, emits : 1, encloses : 1;  ///< as the Surface
  bool touches : 1;                                           ///< some triangle of it touches another
  bool is_pane : 1;                                           ///< see is_free_pane
};

/// A scene made ready for rendering: what every sampler and every render of it share.
struct PreparedScene {
  explicit PreparedScene(Scene source);
  PreparedScene(const PreparedScene&) = delete;  // its parts point to each other
  PreparedScene& operator=(const PreparedScene&) = delete;

  Scene scene;
  std::vector<Surface> surfaces;       ///< of Scene::materials, compiled for shading
  std::unique_ptr<const Quads> quads;  ///< of a large scene, whose triangles they reorder
  std::vector<float> touching;         ///< of triangles [m]: see touching_triangles
  std::vector<ShapeTraits> shapes;     ///< of Geometry::shapes
  Accel accel;
  LightSampler lights;
};

/// The emission that wavelength samplers adapt to: the scene's emission spectra weighted by luminous flux.
TabulatedSpectrum scene_emission(const PreparedScene& scene);

/// The same lamps one by one, as the optimiser takes them: a lamp_set. Empty when the scene has no light.
std::vector<TabulatedSpectrum> scene_lamps(const PreparedScene& scene);

}  // namespace photopic
