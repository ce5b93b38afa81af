#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/gltf_loader.h"
#include "error.h"

namespace photopic {

/// Tests that write small files get a folder of their own, gone afterwards.
class GltfTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("photopic-{}-{}-{}", test->test_suite_name(), test->name(), ::getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, std::string_view content) const {
    std::ofstream(folder_ / name, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
    return folder_ / name;
  }

  Scene load(const std::string& json, const GltfOptions& options = {}) const {
    Scene scene = load_gltf(write("scene.gltf", json), options);
    // Most of these files have no camera and no light, which is no test's concern but its own.
    std::erase_if(scene.warnings, [](const std::string& text) {
      return text.starts_with("no camera in ") || text.starts_with("nothing in ");
    });
    return scene;
  }

  /// The message of the refusal; it must be one line.
  std::string refusal(const std::string& json, const GltfOptions& options = {}) const {
    return message([&] { load(json, options); });
  }

  template <typename Action>
  static std::string message(const Action& action) {
    try {
      action();
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
  }

  std::filesystem::path folder_;
};

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (int k = 3; k >= 0; --k) text += digits[word >> 6 * k & 63];
  }
  for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) text[text.size() - 1 - k] = '=';
  return text;
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A unit square in z = 0 facing +z: four positions (accessor 0) and six indices (accessor 1). The parts of
/// the file are for the tests to change.
struct SquareFile {
  std::string asset = R"({"version": "2.0"})";
  std::string nodes = R"([{"mesh": 0}])";
  std::string roots = "[0]";
  std::string primitive = R"("attributes": {"POSITION": 0}, "indices": 1)";
  std::string materials = R"([{"name": "plain"}])";
  std::string accessors =
      R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"})";
  std::string views = R"({"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12})";
  std::string more;  ///< further top-level members, each with a comma before it
  std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<std::uint16_t> indices = {0, 1, 2, 0, 2, 3};
  std::string tail;  ///< further bytes of the buffer
  std::string uri;   ///< instead of a data URI

  /// Adds an accessor with a view and bytes of its own. @param component its type's number, as
  /// TINYGLTF_COMPONENT_TYPE_… @return its index
  template <typename T>
  int add(const std::vector<T>& values, int component, const char* type, std::size_t count,
          bool normalized = false) {
    tail.append((4 - bytes().size() % 4) % 4, '\0');
    const auto members = [](const std::string& list) { return std::ranges::count(list, '}'); };
    const std::size_t size = values.size() * sizeof(T);
    accessors += fmt::format(
        R"(, {{"bufferView": {}, "componentType": {}, "normalized": {}, "count": {}, "type": "{}"}})",
        members(views), component, normalized, count, type);
    views += fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": {}}})", bytes().size(), size);
    tail += bytes_of(values);
    return static_cast<int>(members(accessors)) - 1;
  }

  std::string bytes() const { return bytes_of(positions) + bytes_of(indices) + tail; }
  std::string buffer() const {
    const std::string place = uri.empty() ? "data:application/octet-stream;base64," + base64(bytes()) : uri;
    return fmt::format(R"({{"byteLength": {}, "uri": "{}"}})", bytes().size(), place);
  }
  std::string str() const {
    return fmt::format(
        R"({{"asset": {}, "scene": 0, "scenes": [{{"nodes": {}}}], "nodes": {}, "meshes": [{{"primitives": [{{{}}}]}}],)"
        R"( "materials": {}, "accessors": [{}], "bufferViews": [{}], "buffers": [{}]{}}})",
        asset, roots, nodes, primitive, materials, accessors, views, buffer(), more);
  }
};

/// Twice the signed area vector of a triangle: its length is twice the area, it points out of the front.
inline Vec3f area_vector(const Scene& scene, std::size_t i) {
  const auto& t = scene.geometry.triangles.at(i);
  const auto& p = scene.geometry.positions;
  return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

}  // namespace photopic
