#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/gltf_contents.h"
#include "core/scene.h"

namespace photopic {

/// `--emitter [NAME=]SPECTRUM`
struct EmitterOverride {
  std::string name;  ///< of the material or light, or "environment"; empty: every emitter
  std::string text;  ///< SPECTRUM as the user wrote it; files relative to the working folder
};

struct GltfOptions {
  std::vector<EmitterOverride> emitters{};  ///< later ones win; a NAME wins over an empty name
  std::string scene{};   ///< name of a scene, else "N" or "index:N"; empty: the default scene, else the first
  std::string camera{};  ///< name of a camera or its node, else "N" or "index:N"; empty: the scene's first
  int width = 0, height = 0;    ///< 0: the camera's `extras.resolution`, else 640 wide by its aspect
  double punctual_scale = 1.0;  ///< factor on the intensities of KHR_lights_punctual
  EnvironmentOptions environment{};
  bool solid_glass = false;  ///< transmission of closed meshes refracts, KHR_materials_volume or not
};

/// Loads a scene of a .gltf or .glb file. Everything read from the file is checked before it is
/// used.
/// @throws InputError naming the file, the JSON pointer of the place, what is wrong and what to do
Scene load_gltf(const std::filesystem::path& file, const GltfOptions& options = {});

/// The same of a file in memory: `file` names it in messages, and other files are sought beside it.
Scene load_gltf(std::vector<char> bytes, const std::filesystem::path& file, const GltfOptions& options = {});

struct ListedScene {
  Scene scene;
  GltfContents contents;
};
/// The same, and what the file lists.
ListedScene load_listed_gltf(const std::filesystem::path& file, const GltfOptions& options = {});

}  // namespace photopic
