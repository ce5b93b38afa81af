#include "core/prepared_scene.h"

#include <algorithm>

#include "core/bsdf/fresnel_albedo.h"
#include "core/bsdf/sheen.h"
#include "core/rough_glass.h"
#include "core/sky_survey.h"
#include "core/touching.h"
#include "spectral/lamp_set.h"
#include "spectral/rgb_light.h"

namespace photopic {
namespace {

std::vector<bool> used_materials(const Scene& scene) {
  std::vector<bool> used(scene.materials.size());
  for (const Shape& shape : scene.geometry.shapes) used[shape.material] = true;
  return used;
}

ShapeTraits traits_of(const Shape& shape, const Surface& surface, std::span<const float> touching) {
  return {.material = shape.material,
          .opaque_kind = surface.opaque_kind,
          .scatters = surface.scatters,
          .transmits = surface.transmits,
          .emits = surface.emits,
          .encloses = surface.encloses,
          .touches = touches(shape, touching),
          .is_pane = is_free_pane(shape, surface, touching)};
}

}  // namespace

void prepare_albedos(const std::vector<bool>& used, std::span<Surface> surfaces, const Geometry& geometry) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!used[i] || !surfaces[i].extensions) continue;
    FresnelAlbedo::table();
    if (surfaces[i].extensions->has_sheen()) SheenAlbedo::table();
  }
  prepare_rough_glass(used, surfaces, geometry);
}

PreparedScene::PreparedScene(Scene source)
    : scene(std::move(source)),
      surfaces(scene.materials.begin(), scene.materials.end()),
      quads(Quads::pair_where_worth(scene.geometry)),
      touching(touching_triangles(scene.geometry, surfaces)),
      accel(scene.geometry, surfaces, quads.get(), touching),
      lights(scene, accel.radius() > 0.0 ? accel.radius() : 1.0, surfaces,
             survey_sky(scene, accel, surfaces)) {
  scene.geometry.normals.reserve(scene.geometry.normals.size() + 1);  // surface_points reads a number more
  for (const Shape& shape : scene.geometry.shapes)
    shapes.push_back(traits_of(shape, surfaces[shape.material], touching));
  // What is made when first asked for is made now, on nobody's clock.
  prepare_albedos(used_materials(scene), surfaces, scene.geometry);
  if (scene.environment) rgb_tints();
}

TabulatedSpectrum scene_emission(const PreparedScene& scene) {
  return mix_emissions(scene.scene.emission_spectra, scene.lights.power_of_spectrum());
}

std::vector<TabulatedSpectrum> scene_lamps(const PreparedScene& scene) {
  return lamp_set(scene.scene.emission_spectra, scene.lights.power_of_spectrum());
}

}  // namespace photopic
