#include "core/prepared_scene.h"

#include "core/rough_glass.h"
#include "core/sheen.h"
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

}  // namespace

void prepare_albedos(std::span<const Material> materials, const std::vector<bool>& used,
                     std::span<Surface> surfaces) {
  std::vector<Surface*> shaded;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!used[i]) continue;
    Surface& s = surfaces[i];
    shaded.push_back(&s);
    if (!s.extensions) continue;
    s.grain_albedo = grain_albedo_of(materials[i]);
    FresnelAlbedo::table();
    if (s.extensions->has_sheen()) SheenAlbedo::table();
  }
  prepare_rough_glass(shaded);
}

PreparedScene::PreparedScene(Scene source)
    : scene(std::move(source)),
      surfaces(scene.materials.begin(), scene.materials.end()),
      quads(Quads::pair_where_worth(scene.geometry)),
      touching(touching_triangles(scene.geometry, surfaces)),
      accel(scene.geometry, surfaces, quads.get(), !touching.empty()),
      lights(scene, accel.radius() > 0.0 ? accel.radius() : 1.0, surfaces) {
  // What is made when first asked for is made now, on nobody's clock.
  prepare_albedos(scene.materials, used_materials(scene), surfaces);
  if (scene.environment) rgb_tints();
}

TabulatedSpectrum scene_emission(const PreparedScene& scene) {
  return mix_emissions(scene.scene.emission_spectra, scene.lights.power_of_spectrum());
}

std::vector<TabulatedSpectrum> scene_lamps(const PreparedScene& scene) {
  return lamp_set(scene.scene.emission_spectra, scene.lights.power_of_spectrum());
}

}  // namespace photopic
