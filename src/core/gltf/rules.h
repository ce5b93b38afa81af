#pragma once

#include <array>
#include <string_view>

#include "core/gltf/material_rules.h"
#include "core/gltf/rule.h"

/// What glTF 2.0's schema (Khronos, ISO/IEC 12113:2022, annex on JSON schema) and its extensions' ask of what
/// the loader may read, object by object. What two members must be to each other, member_checks.h says.
namespace photopic::gltf_rules {

/// tinygltf reads it into an int.
inline constexpr Whole kSparseOffset{0, kMaxCount};

inline constexpr Member kSparseIndices[] = {
    {"bufferView", IndexInto{"bufferViews"}, Form::one, kRequired},
    {"byteOffset", kSparseOffset},
    {"componentType", Whole{5121, 5125}, Form::one, kRequired},
};
inline constexpr Member kSparseValues[] = {
    {"bufferView", IndexInto{"bufferViews"}, Form::one, kRequired},
    {"byteOffset", kSparseOffset},
};
inline constexpr Member kSparse[] = {
    {"count", Whole{1, kMaxCount}, Form::one, kRequired},
    {"indices", Object(kSparseIndices), Form::one, kRequired},
    {"values", Object(kSparseValues), Form::one, kRequired},
};
inline constexpr Member kAccessor[] = {
    {"bufferView", IndexInto{"bufferViews"}},
    {"byteOffset", Whole{0, kMaxBytes}},
    {"componentType", Whole{5120, 5126}, Form::one, kRequired},
    {"count", Whole{1, kMaxCount}, Form::one, kRequired},
    {"type", Text{}, Form::one, kRequired},
    {"normalized", Boolean{}},
    {"sparse", Object(kSparse)},
    {"min", Number{-kNoLimit, kNoLimit}, Form::list},
    {"max", Number{-kNoLimit, kNoLimit}, Form::list},
};
inline constexpr Member kBufferView[] = {
    {"buffer", IndexInto{"buffers"}, Form::one, kRequired},
    {"byteOffset", Whole{0, kMaxBytes}},
    {"byteLength", Whole{1, kMaxBytes}, Form::one, kRequired},
    {"byteStride", Whole{4, 252}},
};
inline constexpr Member kBuffer[] = {
    {"uri", Text{}},
    {"byteLength", Whole{1, kMaxBytes}, Form::one, kRequired},
};

inline constexpr Member kPrimitive[] = {
    {"attributes", IndexInto{"accessors"}, Form::map, kRequired},
    {"indices", IndexInto{"accessors"}},
    {"material", IndexInto{"materials"}},
    {"mode", Whole{0, 6}},
    {"targets", IndexInto{"accessors"}, Form::list_of_maps},
};
inline constexpr Member kMesh[] = {
    {"primitives", Object(kPrimitive), Form::list, kRequired},
    {"weights", Number{-kMaxFloat, kMaxFloat}, Form::list},
};

inline constexpr std::string_view kLights = "extensions/KHR_lights_punctual/lights";
inline constexpr Member kNodeLight[] = {{"light", IndexInto{kLights}, Form::one, kRequired}};
inline constexpr Member kNodeVisibility[] = {{"visible", Boolean{}}};
inline constexpr Member kInstancing[] = {{"attributes", IndexInto{"accessors"}, Form::map, kRequired}};
inline constexpr Member kNodeExtensions[] = {
    {"KHR_lights_punctual", Object(kNodeLight)},
    {"KHR_node_visibility", Object(kNodeVisibility)},
    {"EXT_mesh_gpu_instancing", Object(kInstancing)},
};
inline constexpr Member kNode[] = {
    {"children", IndexInto{"nodes"}, Form::list},
    {"mesh", IndexInto{"meshes"}},
    {"camera", IndexInto{"cameras"}},
    {"skin", IndexInto{"skins"}},
    {"matrix", Numbers{16, -kNoLimit, kNoLimit}},
    {"translation", Numbers{3, -kNoLimit, kNoLimit}},
    {"rotation", Numbers{4, -kNoLimit, kNoLimit}},
    {"scale", Numbers{3, -kNoLimit, kNoLimit}},
    {"weights", Number{-kMaxFloat, kMaxFloat}, Form::list},
    {"extensions", Object(kNodeExtensions)},
};
inline constexpr Member kScene[] = {{"nodes", IndexInto{"nodes"}, Form::list}};
inline constexpr Member kSkin[] = {
    {"joints", IndexInto{"nodes"}, Form::list, kRequired},
    {"skeleton", IndexInto{"nodes"}},
    {"inverseBindMatrices", IndexInto{"accessors"}},
};

inline constexpr Member kPerspective[] = {
    {"yfov", Number{1e-4, 3.1415}, Form::one, kRequired},
    {"aspectRatio", Number{1e-4, 1e4}},
    {"znear", Number{0, kNoLimit}},
    {"zfar", Number{0, kNoLimit}},
};
inline constexpr Member kOrthographic[] = {
    {"xmag", Number{-kMaxFloat, kMaxFloat}, Form::one, kRequired},
    {"ymag", Number{-kMaxFloat, kMaxFloat}, Form::one, kRequired},
    {"znear", Number{0, kNoLimit}, Form::one, kRequired},
    {"zfar", Number{0, kNoLimit}, Form::one, kRequired},
};
inline constexpr std::string_view kCameraTypes[] = {"perspective", "orthographic"};
inline constexpr Member kCamera[] = {
    {"type", OneOf{kCameraTypes}, Form::one, kRequired},
    {"perspective", Object(kPerspective)},
    {"orthographic", Object(kOrthographic)},
};

inline constexpr double kHalfPi = 1.5708;  // π/2, rounded up as exporters round it
inline constexpr Member kSpot[] = {
    {"innerConeAngle", Number{0, kHalfPi}},
    {"outerConeAngle", Number{0, kHalfPi}},
};
inline constexpr std::string_view kLightTypes[] = {"directional", "point", "spot"};
inline constexpr Member kLight[] = {
    {"type", OneOf{kLightTypes}, Form::one, kRequired},
    {"color", kColor},
    {"intensity", kNotNegative},
    {"range", kPositive},
    {"spot", Object(kSpot)},
};
inline constexpr Member kLightsPunctual[] = {{"lights", Object(kLight), Form::list}};
inline constexpr Member kRootExtensions[] = {{"KHR_lights_punctual", Object(kLightsPunctual)}};

/// Animations are not played.
inline constexpr Member kChannelTarget[] = {{"node", IndexInto{"nodes"}}};
inline constexpr Member kChannel[] = {{"target", Object(kChannelTarget)}};
inline constexpr Member kAnimationSampler[] = {
    {"input", IndexInto{"accessors"}},
    {"output", IndexInto{"accessors"}},
};
inline constexpr Member kAnimation[] = {
    {"channels", Object(kChannel), Form::list},
    {"samplers", Object(kAnimationSampler), Form::list},
};

inline constexpr Member kDocument[] = {
    {"extensionsUsed", Text{}, Form::list},         {"extensionsRequired", Text{}, Form::list},
    {"buffers", Object(kBuffer), Form::list},       {"bufferViews", Object(kBufferView), Form::list},
    {"accessors", Object(kAccessor), Form::list},   {"images", Object(kImage), Form::list},
    {"samplers", Object(kSampler), Form::list},     {"textures", Object(kTextureMembers), Form::list},
    {"materials", Object(kMaterial), Form::list},   {"meshes", Object(kMesh), Form::list},
    {"skins", Object(kSkin), Form::list},           {"cameras", Object(kCamera), Form::list},
    {"extensions", Object(kRootExtensions)},        {"nodes", Object(kNode), Form::list},
    {"scenes", Object(kScene), Form::list},         {"scene", IndexInto{"scenes"}},
    {"animations", Object(kAnimation), Form::list},
};

/// Extensions that a file may require: rendered, or without effect on what is rendered.
inline constexpr auto kSupported = std::to_array<std::string_view>({
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_node_visibility",
    "EXT_mesh_gpu_instancing",
    "KHR_materials_variants",
    "KHR_xmp_json_ld",
    "KHR_animation_pointer",
});

}  // namespace photopic::gltf_rules
