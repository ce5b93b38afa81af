#include "core/lights/sky.h"

#include "core/lights/environment.h"
#include "core/scene.h"

namespace photopic {

Sky::Sky(const Scene& scene) : environment(scene.environment.get()) {
  for (const PunctualLight& light : scene.punctual_lights) {
    if (light.kind != PunctualLight::Kind::directional || !(light.intensity > 0.0f)) continue;
    directions.push_back(-light.direction);
    illuminances.push_back(double{light.intensity});
  }
}

std::size_t Sky::tiles() const {
  return environment ? environment->tile_fluxes().size() : 0;
}

std::vector<double> Sky::fluxes() const {
  std::vector<double> result;
  if (environment) result = environment->tile_fluxes();
  result.insert(result.end(), illuminances.begin(), illuminances.end());
  return result;
}

}  // namespace photopic
