#include "core/prepared_scene.h"

#include "core/fresnel_albedo.h"
#include "core/rough_glass.h"
#include "core/sheen.h"
#include "core/touching.h"
#include "spectral/lamp_set.h"
#include "spectral/rgb_light.h"

namespace photopic {

PreparedScene::PreparedScene(Scene source)
    : scene(std::move(source)),
      surfaces(scene.materials.begin(), scene.materials.end()),
      quads(Quads::pair_where_worth(scene.geometry)),
      touching(touching_triangles(scene.geometry, surfaces)),
      accel(scene.geometry, surfaces, quads.get(), !touching.empty()),
      lights(scene, accel.radius() > 0.0 ? accel.radius() : 1.0, surfaces) {
  prepare_rough_glass(surfaces);
  // What is made when first asked for is made now, on nobody's clock.
  if (scene.environment) rgb_tints();
  std::vector<bool> used(surfaces.size());
  for (const Shape& shape : scene.geometry.shapes) used[shape.material] = true;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& s = surfaces[i];
    if (!used[i]) continue;
    if (!s.extensions) continue;
    FresnelAlbedo::table();
    if (s.extensions->has_sheen()) SheenAlbedo::table();
  }
}

TabulatedSpectrum scene_emission(const PreparedScene& scene) {
  return mix_emissions(scene.scene.emission_spectra, scene.lights.power_of_spectrum());
}

std::vector<TabulatedSpectrum> scene_lamps(const PreparedScene& scene) {
  return lamp_set(scene.scene.emission_spectra, scene.lights.power_of_spectrum());
}

}  // namespace photopic
