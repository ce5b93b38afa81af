#include "core/prepared_scene.h"

#include <algorithm>

#include "core/ggx_albedo.h"
#include "core/grain_albedo.h"
#include "core/rough_glass.h"
#include "core/sheen.h"
#include "spectral/lamp_set.h"
#include "spectral/rgb_light.h"

namespace photopic {

PreparedScene::PreparedScene(Scene source)
    : scene(std::move(source)),
      surfaces(scene.materials.begin(), scene.materials.end()),
      accel(scene.geometry, surfaces),
      lights(scene, accel.radius() > 0.0 ? accel.radius() : 1.0, surfaces) {
  prepare_rough_glass(surfaces);
  // What is made when first asked for is made now, on nobody's clock.
  if (scene.environment) rgb_tints();
  const auto is_rough = [](const Surface& s) { return s.opaque_kind != BsdfKind::diffuse || s.transmits; };
  if (std::ranges::any_of(surfaces, is_rough)) GgxAlbedo::table();
  for (const Surface& s : surfaces) {
    if (!s.extensions) continue;
    FresnelAlbedo::table();
    if (s.extensions->anisotropy > 0.0f) GrainAlbedo::table();
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
