#define TINYGLTF_IMPLEMENTATION
#include "core/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/gltf/checks.h"
#include "core/gltf/json_reader.h"
#include "error.h"

namespace photopic {
namespace {

using Json = nlohmann::json;

void load_buffers(GltfDocument& document, const Json& json) {
  if (!json.contains("buffers")) return;
  const Json& list = json.at("buffers");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string pointer = fmt::format("/buffers/{}", i);
    const auto byte_length = list[i].at("byteLength").get<std::size_t>();
    if (list[i].contains("uri")) {
      const std::string where = document.file.path.string() + "#" + pointer + "/uri";
      document.storage.push_back(
          read_gltf_uri(list[i].at("uri").get<std::string>(), byte_length, document.folder(), where));
      document.buffers.emplace_back(document.storage.back());
    } else if (i == 0 && !document.file.bin.empty()) {
      if (document.file.bin.size() < byte_length) {
        document.fail(pointer + "/byteLength", fmt::format("{} bytes are more than the binary chunk's {}",
                                                           byte_length, document.file.bin.size()));
      }
      document.buffers.push_back(document.file.bin);
    } else {
      document.buffers.emplace_back();
    }
  }
}

std::vector<GltfImage> list_images(const Json& json) {
  std::vector<GltfImage> images;
  if (!json.contains("images")) return images;
  const auto text = [](const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  for (const Json& image : json.at("images"))
    images.push_back({text(image, "uri"), image.value("bufferView", -1), text(image, "name")});
  return images;
}

/// Every local file that the document names, whether it is read or not.
std::vector<std::filesystem::path> named_files(const GltfDocument& document, const Json& json) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](const Json& object, const char* key) {
    if (!object.contains(key) || !object.at(key).is_string()) return;
    const std::filesystem::path file = gltf_uri_file(object.at(key).get<std::string>(), document.folder());
    if (!file.empty()) files.push_back(file);
  };
  for (const char* list : {"buffers", "images"})
    if (json.contains(list))
      for (const Json& object : json.at(list)) add(object, "uri");
  const auto add_spectra = [&](const Json& list) {
    for (const Json& object : list)
      if (object.contains("extras") && object.at("extras").is_object())
        for (const auto& [key, value] : object.at("extras").items())
          if (key.ends_with("_spectrum")) add(object.at("extras"), key.c_str());
  };
  if (json.contains("materials")) add_spectra(json.at("materials"));
  const Json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
  if (json.contains(lights)) add_spectra(json.at(lights));
  return files;
}

/// The names of all that stands in "extensions", declared or not. What is in `extras` is others'.
void find_extensions(const Json& value, std::set<std::string>& names) {
  if (value.is_array())
    for (const Json& element : value) find_extensions(element, names);
  if (!value.is_object()) return;
  for (const auto& [key, member] : value.items()) {
    if (key == "extras") continue;
    if (key == "extensions" && member.is_object())
      for (const auto& extension : member.items()) names.insert(extension.key());
    find_extensions(member, names);
  }
}

/// Nodes that give their place in two ways, which they must not (glTF 2.0, section 3.5.3). Other readers take
/// the matrix, as tinygltf does.
std::size_t count_double_transforms(const Json& json) {
  if (!json.contains("nodes")) return 0;
  const auto is_double = [](const Json& node) {
    return node.contains("matrix") &&
           (node.contains("translation") || node.contains("rotation") || node.contains("scale"));
  };
  return static_cast<std::size_t>(std::ranges::count_if(json.at("nodes"), is_double));
}

/// Whole numbers that tinygltf would cut to 32 bits, as it does in extensions and extras, become fractions.
void widen_integers(Json& value, bool cut = false) {
  constexpr double kMaxInt = std::numeric_limits<int>::max();
  if (cut && value.is_number_integer() && std::abs(value.get<double>()) > kMaxInt)
    value = value.get<double>();
  if (value.is_array())
    for (Json& element : value) widen_integers(element, cut);
  if (value.is_object())
    for (auto& [key, member] : value.items())
      widen_integers(member, cut || key == "extensions" || key == "extras");
}

/// tinygltf is given only what has been checked and is needed. It insists on znear, which a path tracer
/// ignores, and on inverseBindMatrices, which may be left out (unit matrices then); it refuses indices
/// without a bufferView, which are valid when sparse: an extra, last view stands for "none" (the accessors'
/// reader knows).
std::string text_for_tinygltf(Json& json) {
  for (const char* unused : {"buffers", "images", "animations"}) json.erase(unused);
  widen_integers(json);
  if (json.contains("cameras")) {
    for (Json& camera : json["cameras"]) {
      if (camera.contains("perspective")) camera["perspective"].emplace("znear", 0.01);
    }
  }
  if (json.contains("skins"))
    for (Json& skin : json["skins"]) skin.emplace("inverseBindMatrices", -1);
  if (json.contains("accessors")) {
    const std::size_t none = json.contains("bufferViews") ? json["bufferViews"].size() : 0;
    json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
    for (Json& accessor : json["accessors"]) accessor.emplace("bufferView", none);
  }
  return json.dump();
}

}  // namespace

void GltfDocument::fail(const std::string& pointer, const std::string& problem,
                        const std::string& remedy) const {
  throw InputError(file.path.string() + "#" + pointer, problem, remedy);
}

GltfDocument read_gltf_document(std::vector<char> bytes, const std::filesystem::path& path) {
  GltfDocument document;
  document.file = split_gltf(std::move(bytes), path);
  Json json = parse_gltf_json(document.file);
  check_gltf(json, path);
  load_buffers(document, json);
  document.images = list_images(json);
  document.named_files = named_files(document, json);
  if (json.contains("extensionsUsed"))
    document.extensions = json.at("extensionsUsed").get<std::set<std::string>>();
  find_extensions(json, document.extensions);
  if (json.contains("animations")) document.animation_count = json.at("animations").size();
  document.double_transforms = count_double_transforms(json);
  document.file.json = {};
  if (document.file.bin.empty())
    document.file.bytes = {};  // text alone, which may hold all buffers in base64

  const std::string text = text_for_tinygltf(json);
  json = nullptr;
  tinygltf::TinyGLTF parser;
  std::string error, warning;
  bool parsed = false;
  try {
    parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, text.data(),
                                        static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!parsed || !error.empty()) {
    throw InputError(path.string(), "the glTF cannot be parsed: " + parser_message(error),
                     "correct it or export the file again");
  }
  return document;
}

}  // namespace photopic
