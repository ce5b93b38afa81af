#pragma once

#include <string>
#include <vector>

#include "core/gltf/document.h"

namespace photopic {

/// The file's scene of that name, else of that index; for an empty name the default scene, else the first,
/// with a warning where there are others. −1: the file has no scenes.
/// @throws InputError when there is no such scene
int choose_scene(const GltfDocument& document, const std::string& name, std::vector<std::string>& warnings);

/// How choose_scene() finds it: by its name, if it is the first so called, else as "index:N". Empty for −1.
std::string scene_handle(const tinygltf::Model& model, int scene);

/// 1 "Other", or 1 where it has no name.
std::string scene_title(const tinygltf::Model& model, int scene);

}  // namespace photopic
