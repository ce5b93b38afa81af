#pragma once

#include <vector>

#include "core/gltf/document.h"
#include "core/texture_slots.h"

namespace photopic {

/// A texture that a glTF material names and the renderer reads.
struct GltfTextureUse {
  const TextureSlot* slot;  ///< what it varies
  int texture;
  std::uint8_t uv_set;
  UvTransform transform;
};

/// All of a material's. An unlit material's base colour is its emission.
std::vector<GltfTextureUse> gltf_texture_uses(const GltfDocument& document, std::size_t material);

/// Gives the scene's used materials (those of a shape) their textures; decodes the images they name and no
/// others.
/// @throws InputError for an image that is missing, damaged or of another kind than PNG and JPEG
void load_gltf_textures(const GltfDocument& document, Scene& scene);

}  // namespace photopic
