#pragma once

#include "core/gltf/rule.h"

/// Materials, their textures and what those need: glTF 2.0, sections 5.8 (textures and samplers: 5.26, 5.30),
/// and the schemas of the KHR_materials extensions.
namespace photopic::gltf_rules {

inline constexpr double kMaxTexCoord = 3;  // TEXCOORD_0 … 3 are read

inline constexpr Member kTextureTransform[] = {
    {"offset", Numbers{2, -kMaxFloat, kMaxFloat}},
    {"rotation", Number{-kMaxFloat, kMaxFloat}},
    {"scale", Numbers{2, -kMaxFloat, kMaxFloat}},
    {"texCoord", Whole{0, kMaxTexCoord}},
};
inline constexpr Member kTextureInfoExtensions[] = {
    {"KHR_texture_transform", Object(kTextureTransform)},
};
/// textureInfo, occlusionTextureInfo and normalTextureInfo.
inline constexpr Member kTextureInfo[] = {
    {"index", IndexInto{"textures"}, Form::one, kRequired},
    {"texCoord", Whole{0, kMaxTexCoord}},
    {"scale", Number{-kMaxFloat, kMaxFloat}},
    {"strength", Number{0, 1}},
    {"extensions", Object(kTextureInfoExtensions)},
};
inline constexpr Object kTexture(kTextureInfo);

inline constexpr Number kUnit{0, 1};
inline constexpr Number kPositive{1e-30, kNoLimit};
inline constexpr Number kNotNegative{0, kMaxFloat};
/// A colour that scales a reflectance may be above 1.
inline constexpr Numbers kUnitColor{3, 0, 1}, kColor{3, 0, kMaxFloat};

inline constexpr Member kMetallicRoughness[] = {
    {"baseColorFactor", Numbers{4, 0, 1}},
    {"metallicFactor", kUnit},
    {"roughnessFactor", kUnit},
    {"baseColorTexture", kTexture},
    {"metallicRoughnessTexture", kTexture},
};
inline constexpr Member kAnisotropy[] = {
    {"anisotropyStrength", kUnit},
    {"anisotropyRotation", Number{-kMaxFloat, kMaxFloat}},
    {"anisotropyTexture", kTexture},
};
inline constexpr Member kClearcoat[] = {
    {"clearcoatFactor", kUnit},           {"clearcoatRoughnessFactor", kUnit},
    {"clearcoatTexture", kTexture},       {"clearcoatRoughnessTexture", kTexture},
    {"clearcoatNormalTexture", kTexture},
};
inline constexpr Member kDiffuseTransmission[] = {
    {"diffuseTransmissionFactor", kUnit},
    {"diffuseTransmissionColorFactor", kUnitColor},
    {"diffuseTransmissionTexture", kTexture},
    {"diffuseTransmissionColorTexture", kTexture},
};
inline constexpr Member kDispersion[] = {{"dispersion", kNotNegative}};
inline constexpr Member kEmissiveStrength[] = {{"emissiveStrength", Number{0, 1e15}}};
inline constexpr Member kIor[] = {{"ior", Number{0, 100}}};  // and not between 0 and 1: material.cpp asks
inline constexpr Member kIridescence[] = {
    {"iridescenceFactor", kUnit},
    {"iridescenceIor", Number{1, 100}},
    {"iridescenceThicknessMinimum", kNotNegative},
    {"iridescenceThicknessMaximum", kNotNegative},
    {"iridescenceTexture", kTexture},
    {"iridescenceThicknessTexture", kTexture},
};
inline constexpr Member kSheen[] = {
    {"sheenColorFactor", kUnitColor},
    {"sheenRoughnessFactor", kUnit},
    {"sheenColorTexture", kTexture},
    {"sheenRoughnessTexture", kTexture},
};
inline constexpr Member kSpecular[] = {
    {"specularFactor", kUnit},
    {"specularColorFactor", kColor},
    {"specularTexture", kTexture},
    {"specularColorTexture", kTexture},
};
inline constexpr Member kTransmission[] = {
    {"transmissionFactor", kUnit},
    {"transmissionTexture", kTexture},
};
inline constexpr Member kVolume[] = {
    {"thicknessFactor", kNotNegative},
    {"attenuationDistance", kPositive},
    {"attenuationColor", kUnitColor},
    {"thicknessTexture", kTexture},
};
inline constexpr Member kMaterialExtensions[] = {
    {"KHR_materials_anisotropy", Object(kAnisotropy)},
    {"KHR_materials_clearcoat", Object(kClearcoat)},
    {"KHR_materials_diffuse_transmission", Object(kDiffuseTransmission)},
    {"KHR_materials_dispersion", Object(kDispersion)},
    {"KHR_materials_emissive_strength", Object(kEmissiveStrength)},
    {"KHR_materials_ior", Object(kIor)},
    {"KHR_materials_iridescence", Object(kIridescence)},
    {"KHR_materials_sheen", Object(kSheen)},
    {"KHR_materials_specular", Object(kSpecular)},
    {"KHR_materials_transmission", Object(kTransmission)},
    {"KHR_materials_unlit", Object()},
    {"KHR_materials_volume", Object(kVolume)},
};

inline constexpr std::string_view kAlphaModes[] = {"OPAQUE", "MASK", "BLEND"};
inline constexpr Member kMaterial[] = {
    {"pbrMetallicRoughness", Object(kMetallicRoughness)},
    {"normalTexture", kTexture},
    {"occlusionTexture", kTexture},
    {"emissiveTexture", kTexture},
    {"emissiveFactor", Numbers{3, 0, 1e6}},  // above 1 from before KHR_materials_emissive_strength
    {"alphaMode", OneOf{kAlphaModes}},
    {"alphaCutoff", kNotNegative},
    {"doubleSided", Boolean{}},
    {"extensions", Object(kMaterialExtensions)},
};

inline constexpr int kMagFilters[] = {9728, 9729};
inline constexpr int kMinFilters[] = {9728, 9729, 9984, 9985, 9986, 9987};
inline constexpr int kWraps[] = {10497, 33071, 33648};
inline constexpr Member kSampler[] = {
    {"magFilter", Code{kMagFilters}},
    {"minFilter", Code{kMinFilters}},
    {"wrapS", Code{kWraps}},
    {"wrapT", Code{kWraps}},
};
inline constexpr Member kOtherSource[] = {{"source", IndexInto{"images"}}};
inline constexpr Member kTextureExtensions[] = {
    {"EXT_texture_avif", Object(kOtherSource)},
    {"EXT_texture_webp", Object(kOtherSource)},
    {"KHR_texture_basisu", Object(kOtherSource)},
    {"MSFT_texture_dds", Object(kOtherSource)},
};
inline constexpr Member kTextureMembers[] = {
    {"source", IndexInto{"images"}},
    {"sampler", IndexInto{"samplers"}},
    {"extensions", Object(kTextureExtensions)},
};
inline constexpr Member kImage[] = {
    {"uri", Text{}},
    {"mimeType", Text{}},
    {"bufferView", IndexInto{"bufferViews"}},
};

}  // namespace photopic::gltf_rules
