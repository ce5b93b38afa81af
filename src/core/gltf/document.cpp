#define TINYGLTF_IMPLEMENTATION
#include "core/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/gltf/checks.h"
#include "error.h"

namespace photopic {
namespace {

using Json = nlohmann::json;

/// The parser's message without its own tag, "[json.exception…] ", fit for one line.
std::string one_line(std::string text) {
  if (const std::size_t tag = text.find("] "); tag != std::string::npos) text.erase(0, tag + 2);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 32; }, ' ');
  return text.substr(0, 300);
}

Json parse_json(const GltfFile& file) {
  try {
    return Json::parse(file.json);
  } catch (const Json::exception& error) {
    throw InputError(file.path.string(), "the JSON cannot be parsed: " + one_line(error.what()),
                     "correct it or export the file again");
  }
}

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

/// tinygltf is given only what has been checked and is needed. It insists on znear and zfar, which a path
/// tracer ignores, and refuses indices without a bufferView, which are valid when sparse: an extra, last view
/// stands for "none" (the accessors' reader knows).
std::string text_for_tinygltf(Json& json) {
  for (const char* unused : {"buffers", "images", "textures", "samplers", "animations"}) json.erase(unused);
  if (json.contains("cameras")) {
    for (Json& camera : json["cameras"]) {
      for (const char* type : {"perspective", "orthographic"}) {
        if (!camera.contains(type)) continue;
        camera[type].emplace("znear", 0.01);
        camera[type].emplace("zfar", 100.0);
      }
    }
  }
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

GltfDocument read_gltf_document(const std::filesystem::path& path) {
  GltfDocument document{.file = read_gltf_file(path), .model = {}, .storage = {}, .buffers = {}};
  Json json = parse_json(document.file);
  check_gltf(json, path);
  load_buffers(document, json);
  document.file.json = {};
  if (document.file.bin.empty())
    document.file.bytes = {};  // text alone, which may hold all buffers in base64

  const std::string text = text_for_tinygltf(json);
  json = {};
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
    throw InputError(path.string(), "the glTF cannot be parsed: " + one_line(error),
                     "correct it or export the file again");
  }
  return document;
}

}  // namespace photopic
