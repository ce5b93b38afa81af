#include "integrator/features.h"

#include <algorithm>

#include "integrator/media.h"

namespace photopic {

Features features_of(const PreparedScene& scene) {
  const auto varies = [](const Surface& s) {
    return s.textures || s.base_varies || s.emission_varies || s.partly_covers;
  };
  return {.several_lights = !scene.lights.empty() && !scene.lights.has_only_light(),
          .textures = std::ranges::any_of(scene.surfaces, varies),
          .media = has_media(scene),
          .environment = scene.scene.environment != nullptr};
}

}  // namespace photopic
