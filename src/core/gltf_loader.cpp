#include "core/gltf_loader.h"

#include <fmt/format.h>

#include <algorithm>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "core/gltf/camera.h"
#include "core/gltf/document.h"
#include "core/gltf/emission.h"
#include "core/gltf/geometry.h"
#include "core/gltf/lights.h"
#include "core/gltf/material.h"
#include "core/gltf/nodes.h"
#include "core/gltf/rules.h"
#include "core/gltf/scene_choice.h"
#include "core/gltf/solid_glass.h"
#include "core/gltf/stray_extras.h"
#include "core/gltf/texture.h"
#include "error.h"

namespace photopic {
namespace {

void warn_of_ignored(const GltfDocument& document, std::vector<std::string>& warnings) {
  const auto known = [](const std::string& name) {
    return std::ranges::count(gltf_rules::kSupported, name) > 0;
  };
  for (const std::string& name : document.extensions)
    if (!known(name)) warnings.push_back(fmt::format("the extension {} is ignored", name.substr(0, 60)));
  if (document.animation_count > 0)
    warnings.push_back(fmt::format("animations are not played: {}", document.animation_count));
  if (document.double_transforms > 0)
    warnings.push_back(fmt::format(
        "nodes with a matrix beside translation, rotation or scale, of which the matrix counts: {}",
        document.double_transforms));
}

/// To the system: the allocator would keep what the file and its arrays took, some tens of megabytes, while
/// the BVH is built.
void give_back_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

Scene read_scene(const GltfDocument& document, const GltfOptions& options) {
  Scene scene;
  scene.files = document.named_files;
  scene.scene_index = choose_scene(document, options.scene, scene.warnings);
  scene.scene_name = scene_handle(document.model, scene.scene_index);
  const std::vector<NodeInstance> instances = walk_nodes(document, scene.scene_index, scene.warnings);
  warn_of_ignored(document, scene.warnings);
  warn_of_stray_extras(document, scene.warnings);
  load_gltf_materials(document, scene);
  if (options.solid_glass) make_closed_glass_solid(document, instances, scene);
  load_gltf_geometry(document, instances, scene);
  if (scene.geometry.triangles.empty())
    scene.warnings.push_back(
        fmt::format("no triangles in {}: the background alone is seen", document.file.path.string()));
  load_gltf_textures(document, scene);
  warn_of_unsound_glass(document, instances, scene);
  GltfEmissions emissions(document, options.emitters, scene);
  load_gltf_emission(document, emissions, scene);
  load_gltf_lights(document, instances, options, emissions, scene);
  load_gltf_environment(document, options, emissions, scene);
  emissions.check_overrides();
  load_gltf_camera(document, instances, options, scene);
  return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& file, const GltfOptions& options) {
  return load_gltf(read_gltf_bytes(file), file, options);
}

Scene load_gltf(std::vector<char> bytes, const std::filesystem::path& file, const GltfOptions& options) {
  Scene scene = read_scene(read_gltf_document(std::move(bytes), file), options);
  give_back_free_memory();
  return scene;
}

ListedScene load_listed_gltf(const std::filesystem::path& file, const GltfOptions& options) {
  const GltfDocument document = read_gltf_document(read_gltf_bytes(file), file);
  return {read_scene(document, options), list_contents(document)};
}

}  // namespace photopic
