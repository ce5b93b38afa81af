#include "core/gltf/stray_extras.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace photopic {
namespace {

/// The owners that are read.
constexpr std::string_view kMaterials = "/materials", kCameras = "/cameras",
                           kLights = "/extensions/KHR_lights_punctual/lights";

struct KnownKey {
  std::string_view name;
  std::array<std::string_view, 2> owners;  ///< lists of the file; may be one
  std::string_view belongs_to;
};
constexpr std::string_view kMaterial = "a material", kCamera = "a camera (Blender: its data)";
constexpr KnownKey kKnown[] = {
    {"emission_spectrum", {kMaterials, kLights}, "a material or a light (Blender: its data)"},
    {"reflectance_spectrum", {kMaterials}, kMaterial},
    {"conductor", {kMaterials}, kMaterial},
    {"glass", {kMaterials}, kMaterial},
    {"solid", {kMaterials}, kMaterial},
    {"priority", {kMaterials}, kMaterial},
    {"aperture_radius", {kCameras}, kCamera},
    {"focus_distance", {kCameras}, kCamera},
    {"resolution", {kCameras}, kCamera},
};

/// The same but for case, and blanks or hyphens for underscores.
bool alike(std::string_view key, std::string_view known) {
  const auto plain = [](char c) {
    if (c == ' ' || c == '-') return '_';
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::ranges::equal(key, known, {}, plain);
}

class StrayExtras {
 public:
  /// @param list JSON pointer of the list that the object stands in, @param object of the object itself
  void look_at(const tinygltf::Value& extras, std::string_view list, const std::string& object) {
    if (!extras.IsObject()) return;
    for (const auto& [key, value] : extras.Get<tinygltf::Value::Object>())
      for (const KnownKey& known : kKnown)
        if (alike(key, known.name)) look_at(key, known, list, object);
  }

  void warn(std::vector<std::string>& warnings) const {
    for (const auto& [key, stray] : found_) {
      const std::string more = stray.count > 1 ? fmt::format(" and {} more like it", stray.count - 1) : "";
      warnings.push_back(
          fmt::format("#{}{} {} not read: {}", stray.place, more, more.empty() ? "is" : "are", stray.remedy));
    }
  }

 private:
  struct Stray {
    std::string place, remedy;  ///< of the first
    std::size_t count = 0;
  };

  void look_at(const std::string& key, const KnownKey& known, std::string_view list,
               const std::string& object) {
    const bool right_owner = std::ranges::count(known.owners, list) > 0;
    if (right_owner && key == known.name) return;
    Stray& stray = found_[{std::string(list), key}];
    if (stray.count++ > 0) return;
    stray.place = object + "/extras/" + key;
    stray.remedy = right_owner ? fmt::format("write \"{}\"", known.name)
                               : fmt::format("\"{}\" belongs to {}", known.name, known.belongs_to);
  }

  std::map<std::pair<std::string, std::string>, Stray> found_;  ///< by list and key
};

/// @param list JSON pointer of the list
template <typename List>
void look_at_all(const List& list, std::string_view pointer, StrayExtras& stray) {
  for (std::size_t i = 0; i < list.size(); ++i)
    stray.look_at(list[i].extras, pointer, fmt::format("{}/{}", pointer, i));
}

}  // namespace

void warn_of_stray_extras(const GltfDocument& document, std::vector<std::string>& warnings) {
  const tinygltf::Model& model = document.model;
  StrayExtras stray;
  look_at_all(model.nodes, "/nodes", stray);
  look_at_all(model.meshes, "/meshes", stray);
  look_at_all(model.scenes, "/scenes", stray);
  look_at_all(model.materials, kMaterials, stray);
  look_at_all(model.cameras, kCameras, stray);
  look_at_all(model.lights, kLights, stray);
  for (std::size_t i = 0; i < model.meshes.size(); ++i)
    for (std::size_t k = 0; k < model.meshes[i].primitives.size(); ++k)
      stray.look_at(model.meshes[i].primitives[k].extras, "/primitives",
                    fmt::format("/meshes/{}/primitives/{}", i, k));
  stray.warn(warnings);
}

}  // namespace photopic
