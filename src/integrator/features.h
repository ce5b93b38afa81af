#pragma once

#include "core/prepared_scene.h"

namespace photopic {

/// What a scene may have that every step of a path would have to ask about.
struct Features {
  bool several_lights = false;  ///< else there is none, or one area light
  bool textures = false;        ///< anything that varies over a surface: normals, coverage, emission too
  bool media = false;           ///< glass that rays can enter
  bool environment = false;

  constexpr bool cover(const Features& scene) const {
    return several_lights >= scene.several_lights && textures >= scene.textures && media >= scene.media &&
           environment >= scene.environment;
  }
};

Features features_of(const PreparedScene& scene);

/// The inner loops that are compiled, each for 1, 4, 8 and 16 wavelengths. A scene gets the first that covers
/// it, which does not ask for what it lacks; of the rest it asks the scene.
inline constexpr Features kPlain{};
inline constexpr Features kManyLights{.several_lights = true};
inline constexpr Features kTextured{.several_lights = true, .textures = true};
inline constexpr Features kGlass{.several_lights = true, .textures = true, .media = true};
inline constexpr Features kEverything{true, true, true, true};

/// F(N, features) for each of them.
#define PHOTOPIC_FOR_EACH_LOOP(F)         \
  PHOTOPIC_FOR_EACH_WIDTH(F, kPlain)      \
  PHOTOPIC_FOR_EACH_WIDTH(F, kManyLights) \
  PHOTOPIC_FOR_EACH_WIDTH(F, kTextured)   \
  PHOTOPIC_FOR_EACH_WIDTH(F, kGlass)      \
  PHOTOPIC_FOR_EACH_WIDTH(F, kEverything)
#define PHOTOPIC_FOR_EACH_WIDTH(F, features) F(1, features) F(4, features) F(8, features) F(16, features)

}  // namespace photopic
