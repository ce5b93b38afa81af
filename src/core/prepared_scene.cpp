#include "core/prepared_scene.h"

namespace photopic {

PreparedScene::PreparedScene(Scene source)
    : scene(std::move(source)),
      surfaces(scene.materials.begin(), scene.materials.end()),
      accel(scene.geometry),
      lights(scene) {}

TabulatedSpectrum scene_emission(const PreparedScene& scene) {
  return mix_emissions(scene.scene.emission_spectra, scene.lights.power_of_spectrum());
}

}  // namespace photopic
