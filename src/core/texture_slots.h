#pragma once

#include "core/scene.h"

namespace photopic {

/// One of the textures that a material may have.
struct TextureSlot {
  Texture MaterialTextures::*texture;
  const char* name;
  const char* extension;  ///< of glTF, that has it; null: every material
  const char* key;        ///< of glTF's textureInfo object
  bool srgb;              ///< encoded as colours are; else linear
  bool is_normal_map = false;
};

/// All that are read; occlusion, which a path tracer finds by itself, and the thickness of volumes, which it
/// does not need, are left out.
inline constexpr TextureSlot kTextureSlots[] = {
    {&MaterialTextures::base_color, "base color", nullptr, "baseColorTexture", true},
    {&MaterialTextures::metallic_roughness, "metallic-roughness", nullptr, "metallicRoughnessTexture", false},
    {&MaterialTextures::normal, "normal", nullptr, "normalTexture", false, true},
    {&MaterialTextures::emissive, "emissive", nullptr, "emissiveTexture", true},
    {&MaterialTextures::transmission, "transmission", "KHR_materials_transmission", "transmissionTexture",
     false},
    {&MaterialTextures::specular, "specular", "KHR_materials_specular", "specularTexture", false},
    {&MaterialTextures::specular_color, "specular color", "KHR_materials_specular", "specularColorTexture",
     true},
    {&MaterialTextures::clearcoat, "clearcoat", "KHR_materials_clearcoat", "clearcoatTexture", false},
    {&MaterialTextures::clearcoat_roughness, "clearcoat roughness", "KHR_materials_clearcoat",
     "clearcoatRoughnessTexture", false},
    {&MaterialTextures::clearcoat_normal, "clearcoat normal", "KHR_materials_clearcoat",
     "clearcoatNormalTexture", false, true},
    {&MaterialTextures::sheen_color, "sheen color", "KHR_materials_sheen", "sheenColorTexture", true},
    {&MaterialTextures::sheen_roughness, "sheen roughness", "KHR_materials_sheen", "sheenRoughnessTexture",
     false},
    {&MaterialTextures::anisotropy, "anisotropy", "KHR_materials_anisotropy", "anisotropyTexture", false},
    {&MaterialTextures::iridescence, "iridescence", "KHR_materials_iridescence", "iridescenceTexture", false},
    {&MaterialTextures::iridescence_thickness, "iridescence thickness", "KHR_materials_iridescence",
     "iridescenceThicknessTexture", false},
    {&MaterialTextures::diffuse_transmission, "diffuse transmission", "KHR_materials_diffuse_transmission",
     "diffuseTransmissionTexture", false},
    {&MaterialTextures::diffuse_transmission_color, "diffuse transmission color",
     "KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture", true},
};

}  // namespace photopic
