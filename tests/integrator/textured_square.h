#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "support/render_checks.h"

/// What tests of textures and of alpha are put together from.
namespace photopic::test {

using Texels = std::vector<std::uint8_t>;

/// An image of as many rows as columns.
inline Texture square_texture(int size, int channels, Texels texels) {
  return {.image = std::make_shared<TextureImage>(TextureImage{"", size, size, channels, std::move(texels)}),
          .nearest = true,
          .srgb = true};
}

inline Material textured(Material material, const std::function<void(MaterialTextures&)>& set) {
  MaterialTextures textures;
  set(textures);
  material.textures = std::make_shared<MaterialTextures>(textures);
  return material;
}

/// Gives every quad the whole image, upright as seen from its front.
inline Scene unwrapped(const SceneBuilder& builder) {
  Scene scene = builder.build();
  constexpr Vec2f kCorners[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  for (std::size_t i = 0; i < scene.geometry.positions.size(); ++i)
    scene.geometry.uvs[0].push_back(kCorners[i % 4]);
  return scene;
}

inline Film film_of(const Scene& scene, int spp, std::uint32_t seed = 1) {
  return render_finite(PreparedScene(scene), spp, 12, seed);
}

inline constexpr double kLuminance = 3.0;

/// A box that emits evenly from all its walls and reflects nothing.
inline SceneBuilder furnace(const Spectrum& spectrum) {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(spectrum, kLuminance), true);
  return b;
}

/// A square of side 1 at z = 0 facing up, seen from above by a camera that it just fills, the image's top at
/// the top.
inline void add_square(SceneBuilder& b, const Material& material, int resolution) {
  b.floor({0, 0, 0}, 0.5, 0.5, b.material(material));
  b.camera({0, 0, 1.5}, {0, 0, 0}, 2 * std::atan(0.5 / 1.5) * 180 / std::numbers::pi, resolution, resolution);
}

}  // namespace photopic::test
