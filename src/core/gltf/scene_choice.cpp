#include "core/gltf/scene_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/gltf/name_choice.h"
#include "error.h"

namespace photopic {
namespace {

int default_scene(const tinygltf::Model& model, std::vector<std::string>& warnings) {
  if (model.scenes.empty()) return -1;
  const int scene = std::max(model.defaultScene, 0);
  if (model.scenes.size() > 1)
    warnings.push_back(fmt::format("of the file's {} scenes scene {} is rendered; --scene chooses another",
                                   model.scenes.size(), scene_title(model, scene)));
  return scene;
}

[[noreturn]] void refuse_scene(const GltfDocument& document, const std::string& name) {
  const auto& scenes = document.model.scenes;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    names.push_back(scenes[i].name.empty() ? fmt::format("index:{}", i) : scenes[i].name);
  throw InputError("--scene " + name, document.file.path.string() + " has no scene of that name or index",
                   names.empty() ? "leave the option out" : choose_one_of(names, name));
}

}  // namespace

int choose_scene(const GltfDocument& document, const std::string& name, std::vector<std::string>& warnings) {
  const auto& scenes = document.model.scenes;
  if (name.empty()) return default_scene(document.model, warnings);
  const auto first = std::ranges::find(scenes, name, &tinygltf::Scene::name);
  if (first != scenes.end()) {
    const auto second = std::find_if(first + 1, scenes.end(), [&](const auto& s) { return s.name == name; });
    if (second != scenes.end())
      warnings.push_back(namesake_warning("scene", name, static_cast<int>(second - scenes.begin())));
    return static_cast<int>(first - scenes.begin());
  }
  const int index = parse_index(name);
  if (index < 0 || index >= static_cast<int>(scenes.size())) refuse_scene(document, name);
  return index;
}

std::string scene_handle(const tinygltf::Model& model, int scene) {
  if (scene < 0) return "";
  const std::string& name = model.scenes[static_cast<std::size_t>(scene)].name;
  const auto first = std::ranges::find(model.scenes, name, &tinygltf::Scene::name);
  return name.empty() || first - model.scenes.begin() != scene ? fmt::format("index:{}", scene) : name;
}

std::string scene_title(const tinygltf::Model& model, int scene) {
  const std::string& name = model.scenes[static_cast<std::size_t>(scene)].name;
  return name.empty() ? std::to_string(scene) : fmt::format("{} \"{}\"", scene, name.substr(0, 60));
}

}  // namespace photopic
