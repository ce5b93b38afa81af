#pragma once

#include <string>
#include <vector>

#include "core/gltf/document.h"
#include "core/scene.h"

namespace photopic {

/// A texture that a glTF material names and the renderer reads.
struct GltfTextureUse {
  Texture MaterialTextures::*slot;  ///< what it varies
  bool srgb;
  std::string pointer;  ///< of the textureInfo object
  int texture;
  std::uint8_t uv_set;
  UvTransform transform;
};

/// All of a material's; occlusion, which a path tracer finds by itself, and the thickness of volumes, which
/// it does not need, are left out. An unlit material's base colour is its emission.
std::vector<GltfTextureUse> gltf_texture_uses(const GltfDocument& document, std::size_t material);

/// Gives the scene's used materials (those of a shape) their textures; decodes the images they name and no
/// others.
/// @throws InputError for an image that is missing, damaged or of another kind than PNG and JPEG
void load_gltf_textures(const GltfDocument& document, Scene& scene);

}  // namespace photopic
