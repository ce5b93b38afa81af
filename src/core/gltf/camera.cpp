#include "core/gltf/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/framing.h"
#include "core/gltf/name_choice.h"
#include "core/gltf/scene_choice.h"
#include "error.h"

namespace photopic {
namespace {

constexpr double kMaxPixels = 1 << 28;  // the film takes 56 bytes a pixel
constexpr int kDefaultWidth = 640;
constexpr double kDefaultAspect = 4.0 / 3.0;

/// Warns where the chosen camera shares its name with others of the file.
void warn_of_namesakes(const std::string& name, const std::vector<int>& indices,
                       std::vector<std::string>& warnings) {
  const auto other = std::ranges::find_if(indices, [&](int index) { return index != indices.front(); });
  if (other == indices.end()) return;
  warnings.push_back(namesake_warning("camera", name, *other));
}

bool is_called(const tinygltf::Model& model, const tinygltf::Node& node, const std::string& name) {
  return node.camera >= 0 && (model.cameras[node.camera].name == name || node.name == name);
}

/// The first scene that holds the camera of that name, or of that index in the file's list; −1: none.
int find_scene(const tinygltf::Model& model, const std::string& name) {
  const int index = parse_index(name);
  std::vector<bool> seen(model.nodes.size());
  for (std::size_t scene = 0; scene < model.scenes.size(); ++scene) {
    std::vector<int> pending = model.scenes[scene].nodes;
    while (!pending.empty()) {
      const int i = pending.back();
      const tinygltf::Node& node = model.nodes[i];
      pending.pop_back();
      if (seen[i]) continue;
      seen[i] = true;
      if (is_called(model, node, name) || (index >= 0 && node.camera == index))
        return static_cast<int>(scene);
      pending.insert(pending.end(), node.children.begin(), node.children.end());
    }
  }
  return -1;
}

/// Whether the file has the camera, with a node or without.
bool is_listed(const tinygltf::Model& model, const std::string& name) {
  const int index = parse_index(name);
  return (index >= 0 && index < static_cast<int>(model.cameras.size())) ||
         std::ranges::count(model.cameras, name, &tinygltf::Camera::name) > 0 ||
         std::ranges::any_of(model.nodes, [&](const auto& node) { return is_called(model, node, name); });
}

/// @param names of the scene's cameras
[[noreturn]] void refuse_camera(const GltfDocument& document, const std::string& name,
                                const std::vector<std::string>& names) {
  std::string problem = "has no camera of that name or index";
  std::string remedy = names.empty() ? "add one, or leave the option out" : choose_one_of(names, name);
  if (const int scene = find_scene(document.model, name); scene >= 0) {
    problem = fmt::format("has that camera in scene {}, not in the one that is rendered",
                          scene_title(document.model, scene));
    remedy = fmt::format("render that one by --scene index:{}", scene);
  } else if (is_listed(document.model, name)) {
    problem = "has that camera in no scene";
    remedy = "give it a node there";
  }
  throw InputError("--camera " + name, document.file.path.string() + " " + problem, remedy);
}

/// The scene's camera of that name (its own or its node's), else of that index in the file's list; the first
/// of all for an empty name.
const NodeInstance* choose_camera(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                                  const std::string& name, std::vector<std::string>& warnings) {
  const auto& model = document.model;
  const int wanted = parse_index(name);
  const NodeInstance *by_name = nullptr, *by_index = nullptr;
  std::vector<int> namesakes;
  std::vector<std::string> names;
  for (const NodeInstance& instance : instances) {
    const tinygltf::Node& node = model.nodes[instance.node];
    if (node.camera < 0) continue;
    if (name.empty()) return &instance;
    const std::string& own = model.cameras[node.camera].name;
    if (is_called(model, node, name)) {
      if (!by_name) by_name = &instance;
      namesakes.push_back(node.camera);
    }
    if (node.camera == wanted && !by_index) by_index = &instance;
    const std::string& shown = own.empty() ? node.name : own;
    names.push_back(shown.empty() ? fmt::format("index:{}", node.camera) : shown);
  }
  warn_of_namesakes(name, namesakes, warnings);
  if (by_name) return by_name;
  if (name.empty() || by_index) return by_index;
  refuse_camera(document, name, names);
}

/// A camera's `extras`, which glTF leaves to its users.
class CameraExtras {
 public:
  CameraExtras(const GltfDocument& document, int camera)
      : document_(document), camera_(camera), extras_(document.model.cameras[camera].extras) {}

  bool has(const char* key) const { return extras_.IsObject() && extras_.Has(key); }

  /// A length [m], 0 when there is none.
  float length(const char* key) const {
    if (!has(key)) return 0.0f;
    const tinygltf::Value& value = extras_.Get(key);
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
    if (!(number >= 0 && number <= 1e15)) fail(key, "this is no length", "write a number of metres");
    return static_cast<float>(number);
  }

  /// `resolution`, a list of two whole numbers.
  void read_resolution(Camera& camera) const {
    if (!has("resolution")) return;
    const tinygltf::Value& list = extras_.Get("resolution");
    const auto component = [&](int i) {
      const bool good = list.IsArray() && list.ArrayLen() == 2 && list.Get(i).IsNumber();
      const double value = good ? list.Get(i).GetNumberAsDouble() : 0.0;
      if (!(value >= 1 && value <= 65536 && value == std::floor(value)))
        fail("resolution", "this is no pair of whole numbers from 1 to 65536",
             "write [width, height] in pixels");
      return static_cast<int>(value);
    };
    camera.width = component(0);
    camera.height = component(1);
  }

  void read_lens(Camera& camera) const {
    camera.aperture_radius = length("aperture_radius");
    camera.focus_distance = length("focus_distance");
    if (camera.has_lens() && !(camera.focus_distance > 0.0f))
      fail("aperture_radius", "an aperture needs a distance that is in focus",
           "add \"focus_distance\" in metres");
  }

 private:
  [[noreturn]] void fail(const char* key, const std::string& problem, const std::string& remedy) const {
    document_.fail(fmt::format("/cameras/{}/extras/{}", camera_, key), problem, remedy);
  }

  const GltfDocument& document_;
  int camera_;
  const tinygltf::Value& extras_;
};

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

/// Sets the lens; @return width / height as the file has it. Of an orthographic camera's magnifications the
/// sign turns nothing: the specification advises against negative ones.
double read_projection(const GltfDocument& document, int index, Camera& camera) {
  const tinygltf::Camera& source = document.model.cameras[index];
  if (source.type == "perspective") {
    camera.tan_half_yfov = static_cast<float>(std::tan(0.5 * source.perspective.yfov));
    return source.perspective.aspectRatio > 0 ? source.perspective.aspectRatio : kDefaultAspect;
  }
  const double x = std::abs(source.orthographic.xmag), y = std::abs(source.orthographic.ymag);
  const auto check = [&](double magnification, const char* key) {
    if (!(magnification >= 1e-15 && magnification <= 1e15))
      document.fail(fmt::format("/cameras/{}/orthographic/{}", index, key),
                    fmt::format("{} m is no half width or height of a view", magnification));
  };
  check(x, "xmag"), check(y, "ymag");
  camera.half_height = static_cast<float>(y);
  return x / y;
}

/// The options' resolution, else the camera's own, else the default width by its aspect.
void set_resolution(const GltfDocument& document, double aspect, const GltfOptions& options, Camera& camera) {
  if (options.width > 0 && options.height > 0) {
    camera.width = options.width;
    camera.height = options.height;
  } else if (camera.width == 0) {
    camera.width = kDefaultWidth;
    camera.height = static_cast<int>(std::lround(std::clamp(kDefaultWidth / aspect, 1.0, 65536.0)));
  }
  if (static_cast<double>(camera.width) * camera.height > kMaxPixels) {
    throw InputError(document.file.path.string(),
                     fmt::format("a picture of {} x {} pixels is too large", camera.width, camera.height),
                     "choose a smaller --resolution");
  }
}

}  // namespace

void load_gltf_camera(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                      const GltfOptions& options, Scene& scene) {
  scene.camera = Camera{};
  if (const NodeInstance* instance = choose_camera(document, instances, options.camera, scene.warnings)) {
    const int index = document.model.nodes[instance->node].camera;
    const std::string& name = document.model.cameras[index].name;
    scene.camera_index = index;
    scene.camera_name = name.empty() ? document.model.nodes[instance->node].name : name;
    const CameraExtras extras(document, index);
    const double aspect = read_projection(document, index, scene.camera);
    place(document, *instance, scene.origin, scene.camera);
    extras.read_lens(scene.camera);
    extras.read_resolution(scene.camera);
    set_resolution(document, aspect, options, scene.camera);
    return;
  }
  set_resolution(document, kDefaultAspect, options, scene.camera);
  frame(bounding_sphere(scene.geometry), scene.camera);
  scene.camera_name = "framing the whole scene";
  scene.warnings.push_back(
      fmt::format("no camera in {}: framing the whole scene", document.file.path.string()));
}

}  // namespace photopic
