#include "core/gltf_contents.h"

#include "core/gltf/document.h"

namespace photopic {

GltfContents list_contents(const GltfDocument& document) {
  const tinygltf::Model& model = document.model;
  GltfContents contents;
  for (const auto& scene : model.scenes) contents.scenes.push_back(scene.name);
  contents.nodes = model.nodes.size();
  contents.meshes = model.meshes.size();
  for (const auto& mesh : model.meshes) contents.primitives += mesh.primitives.size();
  contents.materials = model.materials.size();
  contents.animations = document.animation_count;
  contents.extensions_used = model.extensionsUsed;
  contents.extensions_required = model.extensionsRequired;

  for (const auto& camera : model.cameras) contents.cameras.push_back({camera.name, camera.type});
  for (const auto& light : model.lights) contents.lights.push_back({light.name, light.type});
  const auto name_after = [](std::vector<GltfContents::Named>& list, int index, const std::string& name) {
    if (index >= 0 && list[static_cast<std::size_t>(index)].name.empty())
      list[static_cast<std::size_t>(index)].name = name;
  };
  for (const auto& node : model.nodes) {
    name_after(contents.cameras, node.camera, node.name);
    const auto light = node.extensions.find("KHR_lights_punctual");
    if (light != node.extensions.end())
      name_after(contents.lights, light->second.Get("light").GetNumberAsInt(), node.name);
  }
  return contents;
}

}  // namespace photopic
