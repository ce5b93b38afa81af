#pragma once

#include <array>
#include <cstddef>
#include <string_view>

/// What glTF 2.0's schema (Khronos, ISO/IEC 12113:2022, annex on JSON schema) and the KHR material
/// extensions' ask of the parts that the loader reads. In a path, `*` stands for every element of a list or
/// member of an object.
namespace photopic::gltf_rules {

/// A value that is an index into the list `target`.
struct Reference {
  std::string_view path, target;
};
inline constexpr std::string_view kLights = "extensions/KHR_lights_punctual/lights";
inline constexpr auto kReferences = std::to_array<Reference>({
    {"scene", "scenes"},
    {"scenes/*/nodes/*", "nodes"},
    {"nodes/*/children/*", "nodes"},
    {"nodes/*/mesh", "meshes"},
    {"nodes/*/camera", "cameras"},
    {"nodes/*/skin", "skins"},
    {"nodes/*/extensions/KHR_lights_punctual/light", kLights},
    {"meshes/*/primitives/*/attributes/*", "accessors"},
    {"meshes/*/primitives/*/targets/*/*", "accessors"},
    {"meshes/*/primitives/*/indices", "accessors"},
    {"meshes/*/primitives/*/material", "materials"},
    {"accessors/*/bufferView", "bufferViews"},
    {"accessors/*/sparse/indices/bufferView", "bufferViews"},
    {"accessors/*/sparse/values/bufferView", "bufferViews"},
    {"bufferViews/*/buffer", "buffers"},
    {"materials/*/pbrMetallicRoughness/baseColorTexture/index", "textures"},
    {"materials/*/pbrMetallicRoughness/metallicRoughnessTexture/index", "textures"},
    {"materials/*/normalTexture/index", "textures"},
    {"materials/*/occlusionTexture/index", "textures"},
    {"materials/*/emissiveTexture/index", "textures"},
    {"materials/*/extensions/KHR_materials_transmission/transmissionTexture/index", "textures"},
    {"materials/*/extensions/KHR_materials_volume/thicknessTexture/index", "textures"},
    {"materials/*/extensions/KHR_materials_specular/specularTexture/index", "textures"},
    {"materials/*/extensions/KHR_materials_specular/specularColorTexture/index", "textures"},
    {"textures/*/source", "images"},
    {"textures/*/sampler", "samplers"},
    {"images/*/bufferView", "bufferViews"},
    {"skins/*/joints/*", "nodes"},
    {"skins/*/skeleton", "nodes"},
    {"skins/*/inverseBindMatrices", "accessors"},
    {"animations/*/channels/*/target/node", "nodes"},
    {"animations/*/samplers/*/input", "accessors"},
    {"animations/*/samplers/*/output", "accessors"},
});

/// Members that must be there.
struct Required {
  std::string_view path, member;
};
inline constexpr auto kRequired = std::to_array<Required>({
    {"meshes/*", "primitives"},
    {"meshes/*/primitives/*", "attributes"},
    {"accessors/*", "componentType"},
    {"accessors/*", "count"},
    {"accessors/*", "type"},
    {"accessors/*/sparse", "count"},
    {"accessors/*/sparse", "indices"},
    {"accessors/*/sparse", "values"},
    {"accessors/*/sparse/indices", "bufferView"},
    {"accessors/*/sparse/indices", "componentType"},
    {"accessors/*/sparse/values", "bufferView"},
    {"bufferViews/*", "buffer"},
    {"bufferViews/*", "byteLength"},
    {"buffers/*", "byteLength"},
    {"cameras/*", "type"},
    {"cameras/*/perspective", "yfov"},
    {"materials/*/pbrMetallicRoughness/baseColorTexture", "index"},
    {"materials/*/pbrMetallicRoughness/metallicRoughnessTexture", "index"},
    {"materials/*/normalTexture", "index"},
    {"materials/*/occlusionTexture", "index"},
    {"materials/*/emissiveTexture", "index"},
    {"extensions/KHR_lights_punctual/lights/*", "type"},
});

inline constexpr double kNoLimit = 1e300, kMaxBytes = 9007199254740991.0, kMaxCount = 2147483647.0;

/// Whole numbers; the limits keep every later product inside 64 bits.
struct Number {
  std::string_view path;
  double min, max;
};
inline constexpr auto kIntegers = std::to_array<Number>({
    {"buffers/*/byteLength", 1, kMaxBytes},
    {"bufferViews/*/byteOffset", 0, kMaxBytes},
    {"bufferViews/*/byteLength", 1, kMaxBytes},
    {"bufferViews/*/byteStride", 4, 252},
    {"accessors/*/byteOffset", 0, kMaxBytes},
    {"accessors/*/count", 1, kMaxCount},
    {"accessors/*/componentType", 5120, 5126},
    {"accessors/*/sparse/count", 1, kMaxCount},
    {"accessors/*/sparse/indices/byteOffset", 0, kMaxCount},
    {"accessors/*/sparse/indices/componentType", 5121, 5125},
    {"accessors/*/sparse/values/byteOffset", 0, kMaxCount},
    {"meshes/*/primitives/*/mode", 0, 6},
});
inline constexpr auto kNumbers = std::to_array<Number>({
    {"cameras/*/perspective/yfov", 1e-4, 3.1415},
    {"cameras/*/perspective/aspectRatio", 1e-4, 1e4},
    {"cameras/*/perspective/znear", 0, kNoLimit},
    {"materials/*/pbrMetallicRoughness/metallicFactor", 0, 1},
    {"materials/*/pbrMetallicRoughness/roughnessFactor", 0, 1},
    {"materials/*/extensions/KHR_materials_specular/specularFactor", 0, 1},
    {"materials/*/extensions/KHR_materials_ior/ior", 0, 100},
    {"materials/*/extensions/KHR_materials_transmission/transmissionFactor", 0, 1},
    {"materials/*/extensions/KHR_materials_volume/thicknessFactor", 0, kNoLimit},
    {"materials/*/extensions/KHR_materials_volume/attenuationDistance", 1e-30, kNoLimit},
    {"materials/*/extensions/KHR_materials_emissive_strength/emissiveStrength", 0, 1e15},
    {"extensions/KHR_lights_punctual/lights/*/intensity", 0, 1e15},
    {"extensions/KHR_lights_punctual/lights/*/range", 0, kNoLimit},
    {"extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", 0, 1.5708},
    {"extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", 0, 1.5708},
});

/// Lists of `size` numbers. Emission and specular colours above 1 do no harm and are seen in the wild.
struct Vector {
  std::string_view path;
  std::size_t size;
  double min, max;
};
inline constexpr auto kVectors = std::to_array<Vector>({
    {"nodes/*/matrix", 16, -kNoLimit, kNoLimit},
    {"nodes/*/translation", 3, -kNoLimit, kNoLimit},
    {"nodes/*/rotation", 4, -kNoLimit, kNoLimit},
    {"nodes/*/scale", 3, -kNoLimit, kNoLimit},
    {"materials/*/emissiveFactor", 3, 0, 1e6},
    {"extensions/KHR_lights_punctual/lights/*/color", 3, 0, 1e6},
    {"materials/*/pbrMetallicRoughness/baseColorFactor", 4, 0, 1},
    {"materials/*/extensions/KHR_materials_specular/specularColorFactor", 3, 0, kNoLimit},
    {"materials/*/extensions/KHR_materials_volume/attenuationColor", 3, 0, 1},
});

inline constexpr auto kStrings = std::to_array<std::string_view>({
    "nodes/*/name",
    "cameras/*/name",
    "materials/*/name",
    "buffers/*/uri",
    "accessors/*/type",
    "cameras/*/type",
    "extensions/KHR_lights_punctual/lights/*/type",
    "materials/*/alphaMode",
    "extensionsUsed/*",
    "extensionsRequired/*",
});

inline constexpr auto kBooleans =
    std::to_array<std::string_view>({"accessors/*/normalized", "materials/*/doubleSided"});

inline constexpr auto kLists = std::to_array<std::string_view>({
    "accessors",
    "animations",
    "buffers",
    "bufferViews",
    "cameras",
    "extensionsRequired",
    "extensionsUsed",
    "images",
    "materials",
    "meshes",
    "nodes",
    "samplers",
    "scenes",
    "skins",
    "textures",
    "scenes/*/nodes",
    "nodes/*/children",
    "meshes/*/primitives",
});

/// Lists whose elements are objects, and single objects.
inline constexpr auto kObjects = std::to_array<std::string_view>({
    "asset",
    "accessors/*",
    "animations/*",
    "buffers/*",
    "bufferViews/*",
    "cameras/*",
    "images/*",
    "materials/*",
    "meshes/*",
    "meshes/*/primitives/*",
    "meshes/*/primitives/*/attributes",
    "nodes/*",
    "samplers/*",
    "scenes/*",
    "skins/*",
    "textures/*",
    "cameras/*/perspective",
    "cameras/*/orthographic",
    "materials/*/pbrMetallicRoughness",
    "materials/*/extensions/*",
    "accessors/*/sparse",
    "extensions/KHR_lights_punctual/lights/*",
});

/// Extensions that a file may require: rendered, or without effect on what is rendered.
inline constexpr auto kSupported = std::to_array<std::string_view>({
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_materials_variants",
    "KHR_xmp_json_ld",
    "KHR_animation_pointer",
});
/// May be required too, but the loader warns of what it leaves out.
inline constexpr auto kReported = std::to_array<std::string_view>({
    "KHR_materials_unlit",
    "KHR_texture_transform",
});

}  // namespace photopic::gltf_rules
