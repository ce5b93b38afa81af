#include "core/gltf/stray_extras.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

#include "core/gltf/json_place.h"
#include "core/gltf/name_choice.h"

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
constexpr std::size_t kLongest = 60;
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

/// Without what other conventions would write otherwise: "apertureRadius", "Aperture-Radius".
std::string plain(std::string_view key) {
  std::string letters;
  for (const char c : key.substr(0, kLongest))
    if (c != '_' && c != '-' && c != ' ')
      letters += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return letters;
}

/// One letter off, but not the first: "class" is no misspelt "glass".
bool is_misspelt(std::string_view key, std::string_view known) {
  return !key.empty() && key.front() == known.front() && edit_distance(key, known) == 1;
}

class StrayExtras {
 public:
  /// @param list JSON pointer of the list that the object stands in, @param object of the object itself
  void look_at(const tinygltf::Value& extras, std::string_view list, const std::string& object) {
    if (!extras.IsObject()) return;
    for (const auto& [key, value] : extras.Get<tinygltf::Value::Object>()) {
      const std::string letters = plain(key);
      for (const KnownKey& known : kKnown) {
        const std::string wanted = plain(known.name);
        const bool is_read = std::ranges::count(known.owners, list) > 0;
        if (is_read ? key != known.name && (letters == wanted || is_misspelt(letters, wanted))
                    : letters == wanted)
          add(key, known, is_read, list, object);
      }
    }
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

  void add(const std::string& key, const KnownKey& known, bool is_read, std::string_view list,
           const std::string& object) {
    Stray& stray = found_[{std::string(list), key}];
    if (stray.count++ > 0) return;
    stray.place = object + "/extras" + pointer_token(key);
    stray.remedy = is_read ? fmt::format("did you mean \"{}\"?", known.name)
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
