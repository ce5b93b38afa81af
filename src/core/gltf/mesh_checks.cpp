#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "core/gltf/member_checks.h"

namespace photopic {
namespace {

/// An attribute's name, up to its set's number, and what its accessor must be.
struct Semantic {
  std::string_view name;
  std::string_view type, other_type = type;
};
/// glTF 2.0, section 3.7.2.1; EXT_mesh_gpu_instancing.
constexpr std::array kAttributes{
    Semantic{"POSITION", "VEC3"},       Semantic{"NORMAL", "VEC3"},  Semantic{"TANGENT", "VEC4"},
    Semantic{"TEXCOORD_", "VEC2"},      Semantic{"JOINTS_", "VEC4"}, Semantic{"WEIGHTS_", "VEC4"},
    Semantic{"COLOR_", "VEC4", "VEC3"},
};
constexpr std::array kTargets{
    Semantic{"POSITION", "VEC3"},  Semantic{"NORMAL", "VEC3"},         Semantic{"TANGENT", "VEC3"},
    Semantic{"TEXCOORD_", "VEC2"}, Semantic{"COLOR_", "VEC4", "VEC3"},
};
constexpr std::array kInstances{
    Semantic{"TRANSLATION", "VEC3"},
    Semantic{"ROTATION", "VEC4"},
    Semantic{"SCALE", "VEC3"},
};

class AttributeCheck {
 public:
  explicit AttributeCheck(const JsonPlace& root) : root_(root) {}

  /// All accessors of known names must be of their types and of one count: `count` if it is given.
  template <std::size_t N>
  void operator()(const JsonPlace& attributes, const std::array<Semantic, N>& semantics,
                  std::optional<std::uint64_t> count) const {
    for (auto& [key, value] : attributes.value.items()) {
      const auto is_named = [&name = key](const Semantic& s) { return name.starts_with(s.name); };
      const auto semantic = std::ranges::find_if(semantics, is_named);
      if (semantic == semantics.end()) continue;
      const JsonPlace at = attributes.member(key, value);
      const Json& accessor = accessor_of(at);
      const auto& type = accessor.at("type").get_ref<const std::string&>();
      if (type != semantic->type && type != semantic->other_type)
        at.fail(fmt::format("its accessor {} is {}, not {}", value.dump(), type, semantic->type));
      if (accessor.at("componentType") == kUnsignedInt)
        at.fail(fmt::format("its accessor {} holds 32-bit integers, which attributes cannot", value.dump()));
      const auto own = accessor.at("count").get<std::uint64_t>();
      if (count && own != *count)
        at.fail(fmt::format("its accessor holds {} elements where there are {}", own, *count));
      count = own;
    }
  }

  const Json& accessor_of(const JsonPlace& at) const {
    return root_.value.at("accessors").at(at.value.get<std::size_t>());
  }

 private:
  static constexpr int kUnsignedInt = 5125;
  const JsonPlace& root_;
};

std::size_t target_count(const Json& mesh) {
  const Json& primitives = mesh.at("primitives");
  const bool any = !primitives.empty() && primitives[0].contains("targets");
  return any ? primitives[0].at("targets").size() : 0;
}

void check_weights(const JsonPlace& at, std::size_t targets) {
  if (!at.has("weights")) return;
  const JsonPlace weights = at.member("weights");
  if (!weights.value.empty() && weights.value.size() != targets)
    weights.fail(fmt::format("there are {} weights for {} morph targets", weights.value.size(), targets));
}

/// Where Draco is optional, accessors must hold what it compresses, too.
void check_uncompressed(const JsonPlace& at, const AttributeCheck& check) {
  for_extension(at, "KHR_draco_mesh_compression", [&](const JsonPlace& compressed) {
    const auto has_bytes = [&](const JsonPlace& use) {
      const Json& accessor = check.accessor_of(use);
      return accessor.contains("bufferView") || accessor.contains("sparse");
    };
    bool all = !at.has("indices") || has_bytes(at.member("indices"));
    const JsonPlace attributes = at.member("attributes");
    for (auto& [key, value] : attributes.value.items()) all &= has_bytes(attributes.member(key, value));
    if (!all)
      compressed.fail(
          "the mesh is compressed by Draco, which cannot be read, and the file holds it in no other way",
          "export it without compression");
  });
}

void check_primitive(const JsonPlace& at, std::size_t targets, const AttributeCheck& check) {
  check_uncompressed(at, check);
  const JsonPlace attributes = at.member("attributes");
  std::optional<std::uint64_t> count;
  if (attributes.has("POSITION")) count = check.accessor_of(attributes.member("POSITION")).at("count");
  check(attributes, kAttributes, count);
  std::size_t own = 0;
  for_each_in(at, "targets", [&](const JsonPlace& target) {
    check(target, kTargets, count);
    ++own;
  });
  if (own != targets)
    at.fail(fmt::format("it has {} morph targets, the mesh's first primitive {}", own, targets));
}

void check_skin(const JsonPlace& at, const AttributeCheck& check) {
  if (!at.has("inverseBindMatrices")) return;
  const JsonPlace matrices = at.member("inverseBindMatrices");
  const Json& accessor = check.accessor_of(matrices);
  constexpr int kFloat = 5126;
  if (accessor.at("type") != "MAT4" || accessor.at("componentType") != kFloat)
    matrices.fail("its accessor is not MAT4 of floats");
  const std::size_t joints = at.value.at("joints").size();
  if (accessor.at("count") < joints) matrices.fail(fmt::format("it holds fewer than {} matrices", joints));
}

}  // namespace

void check_meshes(const JsonPlace& root) {
  const AttributeCheck check(root);
  for_each_in(root, "meshes", [&](const JsonPlace& mesh) {
    const std::size_t targets = target_count(mesh.value);
    check_weights(mesh, targets);
    for_each_in(mesh, "primitives", [&](const JsonPlace& at) { check_primitive(at, targets, check); });
  });
  for_each_in(root, "nodes", [&](const JsonPlace& node) {
    if (node.has("mesh"))
      check_weights(node, target_count(root.value.at("meshes").at(node.value.at("mesh").get<std::size_t>())));
    for_extension(node, "EXT_mesh_gpu_instancing", [&](const JsonPlace& at) {
      const JsonPlace attributes = at.member("attributes");
      if (attributes.value.empty())
        attributes.fail("it is empty, so that there is no number of instances", "take the extension out");
      check(attributes, kInstances, {});
    });
  });
  for_each_in(root, "skins", [&](const JsonPlace& skin) { check_skin(skin, check); });
}

}  // namespace photopic
