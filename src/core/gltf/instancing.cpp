#include "core/gltf/instancing.h"

#include <fmt/format.h>

#include "core/gltf/accessor.h"

namespace photopic {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";
constexpr std::size_t kMaxPlaces = 4'000'000;  // some 2 GB of instances

/// The transformations that the extension lists (Khronos, EXT_mesh_gpu_instancing).
class InstanceAttributes {
 public:
  InstanceAttributes(const GltfDocument& document, const NodeInstance& place)
      : document_(document), node_(place.node) {
    const tinygltf::Value& attributes =
        document.model.nodes[place.node].extensions.at(kExtension).Get("attributes");
    const auto find = [&](const std::string& name) {
      const int accessor = attributes.Get(name).GetNumberAsInt();
      count_ = document.model.accessors[accessor].count;
      if (count_ > kMaxPlaces) fail("", fmt::format("more than {} instances are too many", kMaxPlaces));
      return accessor;
    };
    find(attributes.Keys().front());  // one of the file's own, as _ID, may be all there is
    const auto read = [&]<typename T>(const char* name, std::vector<T>& values) {
      if (attributes.Has(name)) values = read_elements<T>(document, find(name));
    };
    read("TRANSLATION", translations_);
    read("ROTATION", rotations_);
    read("SCALE", scales_);
  }

  std::size_t size() const { return count_; }

  Affine operator[](std::size_t i) const {
    Affine local;
    if (!rotations_.empty()) {
      const Vec4f& q = rotations_[i];
      const auto turned = rotation(q.x, q.y, q.z, q.w);
      if (!turned) fail("ROTATION", fmt::format("quaternion {} is zero", i));
      local = *turned;
    }
    if (!scales_.empty()) {
      const Vec3d s = to_double(scales_[i]);
      local.x = local.x * s.x, local.y = local.y * s.y, local.z = local.z * s.z;
    }
    if (!translations_.empty()) local.t = to_double(translations_[i]);
    return local;
  }

 private:
  [[noreturn]] void fail(const std::string& attribute, const std::string& problem) const {
    const std::string pointer = fmt::format("/nodes/{}/extensions/{}", node_, kExtension);
    document_.fail(attribute.empty() ? pointer : pointer + "/attributes/" + attribute, problem);
  }

  const GltfDocument& document_;
  int node_;
  std::size_t count_ = 0;
  std::vector<Vec3f> translations_, scales_;
  std::vector<Vec4f> rotations_;
};

}  // namespace

std::vector<NodeInstance> list_mesh_places(const GltfDocument& document,
                                           const std::vector<NodeInstance>& nodes) {
  std::vector<NodeInstance> places;
  for (const NodeInstance& node : nodes) {
    const tinygltf::Node& source = document.model.nodes[node.node];
    if (source.mesh < 0 || !node.visible) continue;
    if (!source.extensions.contains(kExtension)) {
      places.push_back(node);
      continue;
    }
    const InstanceAttributes instances(document, node);
    const std::string pointer = fmt::format("/nodes/{}", node.node);
    if (places.size() + instances.size() > kMaxPlaces)
      document.fail(pointer, fmt::format("the scene holds more than {} instances", kMaxPlaces),
                    "thin it out");
    for (std::size_t i = 0; i < instances.size(); ++i) {
      places.push_back(node);
      places.back().to_world = node.to_world * instances[i];
      if (!is_finite(places.back().to_world))
        document.fail(pointer, fmt::format("its instance {} is not at a finite place", i));
    }
  }
  return places;
}

}  // namespace photopic
