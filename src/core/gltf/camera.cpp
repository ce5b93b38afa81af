#include "core/gltf/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "error.h"

namespace photopic {
namespace {

constexpr double kMaxPixels = 1 << 28;
constexpr int kDefaultWidth = 640;
constexpr double kDefaultAspect = 4.0 / 3.0;

std::optional<NodeInstance> choose_camera(const GltfDocument& document,
                                          const std::vector<NodeInstance>& instances, const std::string& name,
                                          std::vector<std::string>& warnings) {
  const auto& model = document.model;
  std::string names;
  bool orthographic = false;
  for (const NodeInstance& instance : instances) {
    const tinygltf::Node& node = model.nodes[instance.node];
    if (node.camera < 0) continue;
    const tinygltf::Camera& camera = model.cameras[node.camera];
    const bool named = name.empty() || camera.name == name || node.name == name;
    if (camera.type == "perspective" && named) return instance;
    orthographic |= camera.type != "perspective";
    if (camera.type == "perspective")
      names += (names.empty() ? "\"" : ", \"") + (camera.name.empty() ? node.name : camera.name) + "\"";
  }
  if (!name.empty()) {
    throw InputError("--camera " + name,
                     fmt::format("{} has no perspective camera of that name", document.file.path.string()),
                     names.empty() ? "add one" : "choose one of " + names);
  }
  if (orthographic) warnings.emplace_back("orthographic cameras are not supported");
  return std::nullopt;
}

/// `extras.resolution`, a list of two whole numbers.
void read_resolution(const GltfDocument& document, int index, Camera& camera) {
  const tinygltf::Camera& source = document.model.cameras[index];
  if (!source.extras.IsObject() || !source.extras.Has("resolution")) return;
  const tinygltf::Value& list = source.extras.Get("resolution");
  const auto component = [&](int i) {
    const bool good = list.IsArray() && list.ArrayLen() == 2 && list.Get(i).IsNumber();
    const double value = good ? list.Get(i).GetNumberAsDouble() : 0.0;
    if (!(value >= 1 && value <= 65536 && value == std::floor(value))) {
      document.fail(fmt::format("/cameras/{}/extras/resolution", index),
                    "this is no pair of whole numbers from 1 to 65536", "write [width, height] in pixels");
    }
    return static_cast<int>(value);
  };
  camera.width = component(0);
  camera.height = component(1);
}

/// Right-handed and orthonormal whatever the node's scale: only the view and up directions count.
void place(const GltfDocument& document, const NodeInstance& instance, Vec3d origin, Camera& camera) {
  const Affine& m = instance.to_world;
  const Vec3d right = cross(m.y, m.z);
  if (!(length(m.z) > 0) || !(length(right) > 0) || !std::isfinite(length(right))) {
    document.fail(fmt::format("/nodes/{}", instance.node), "its scale leaves the camera no direction",
                  "set the camera's scale to 1");
  }
  const Vec3d back = normalize(m.z), unit_right = normalize(right);
  camera.position = to_float(m.t - origin);
  camera.back = to_float(back);
  camera.right = to_float(unit_right);
  camera.up = to_float(cross(back, unit_right));
}

}  // namespace

void load_gltf_camera(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                      const GltfOptions& options, Scene& scene) {
  const auto instance = choose_camera(document, instances, options.camera, scene.warnings);
  if (!instance) return;
  const int index = document.model.nodes[instance->node].camera;
  const tinygltf::PerspectiveCamera& source = document.model.cameras[index].perspective;

  Camera camera;
  camera.tan_half_yfov = static_cast<float>(std::tan(0.5 * source.yfov));
  place(document, *instance, scene.origin, camera);
  read_resolution(document, index, camera);
  if (camera.width == 0) {
    const double aspect = source.aspectRatio > 0 ? source.aspectRatio : kDefaultAspect;
    camera.width = kDefaultWidth;
    camera.height = std::max(1, static_cast<int>(std::lround(kDefaultWidth / aspect)));
  }
  if (options.width > 0 && options.height > 0) {
    camera.width = options.width;
    camera.height = options.height;
  }
  if (static_cast<double>(camera.width) * camera.height > kMaxPixels) {
    throw InputError(document.file.path.string(),
                     fmt::format("a picture of {} x {} pixels is too large", camera.width, camera.height),
                     "choose a smaller --resolution");
  }
  scene.camera = camera;
  const std::string& name = document.model.cameras[index].name;
  scene.camera_name = name.empty() ? document.model.nodes[instance->node].name : name;
}

}  // namespace photopic
