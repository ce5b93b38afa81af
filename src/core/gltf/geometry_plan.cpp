#include "core/gltf/geometry_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/gltf/instancing.h"

namespace photopic {
namespace {

constexpr std::size_t kMaxVertices = 100'000'000, kMaxTriangles = 100'000'000;  // some 4 GB, instances baked
constexpr std::size_t kMinSaved = 100'000, kMinShared = 8;                      // triangles
constexpr double kMinScale = 1e-4, kMaxScale = 1e6, kMaxGain = 100.0;

/// What can be drawn of a mesh, found once.
struct MeshParts {
  bool known = false;
  std::vector<Part> solid, emissive;
  std::size_t not_triangles = 0, no_positions = 0, quantized = 0;
  std::size_t triangles = 0;  ///< of the solid parts
  std::size_t shareable = 0;  ///< places that might be instances
  std::uint32_t prototype = kNoPlace;
};

/// An --emitter may change what such a material emits, not whether.
bool is_emissive(const GltfDocument& document, int material, const std::vector<Material>& materials) {
  if (material < 0) return false;
  if (materials.at(static_cast<std::size_t>(material)).unlit) return true;
  return std::ranges::any_of(document.model.materials[material].emissiveFactor,
                             [](double c) { return c > 0; });
}

/// glTF 2.0, section 3.7.2.1, has positions and directions as floats, texture coordinates as floats or
/// normalised unsigned integers.
bool is_quantized(const GltfDocument& document, const tinygltf::Primitive& primitive) {
  return std::ranges::any_of(primitive.attributes, [&](const auto& attribute) {
    const auto& [name, index] = attribute;
    const tinygltf::Accessor& accessor = document.model.accessors[index];
    const int type = accessor.componentType;
    if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) return false;
    if (name.starts_with("TEXCOORD_"))
      return !accessor.normalized || type == TINYGLTF_COMPONENT_TYPE_BYTE ||
             type == TINYGLTF_COMPONENT_TYPE_SHORT;
    return name == "POSITION" || name == "NORMAL" || name == "TANGENT";
  });
}

void find_parts(const GltfDocument& document, std::uint32_t mesh, const std::vector<Material>& materials,
                MeshParts& found) {
  const auto& primitives = document.model.meshes[mesh].primitives;
  found.known = true;
  const bool may_quantize = std::ranges::count(document.model.extensionsUsed, "KHR_mesh_quantization") > 0;
  for (std::uint32_t i = 0; i < primitives.size(); ++i) {
    const tinygltf::Primitive& primitive = primitives[i];
    if (!draws_triangles(primitive)) {
      ++found.not_triangles;
    } else if (!primitive.attributes.contains("POSITION")) {
      ++found.no_positions;
    } else {
      const std::size_t material = primitive.material >= 0 ? static_cast<std::size_t>(primitive.material)
                                                           : document.model.materials.size();
      const bool emissive = is_emissive(document, primitive.material, materials);
      (emissive ? found.emissive : found.solid)
          .push_back({kNoPlace, {mesh, i}, static_cast<std::uint32_t>(material)});
      if (!emissive) found.triangles += triangle_count(document, primitive);
      if (!may_quantize && is_quantized(document, primitive)) ++found.quantized;
    }
  }
}

/// Whether single precision can carry rays to the instance and back.
bool is_shareable(const tinygltf::Node& node, const Affine& to_world) {
  if (node.skin >= 0 || !node.weights.empty()) return false;
  for (const Vec3d& axis : {to_world.x, to_world.y, to_world.z})
    if (!(length(axis) >= kMinScale && length(axis) <= kMaxScale)) return false;
  return rounding_gain(to_world) <= kMaxGain;
}

void count_needs(const GltfDocument& document, const std::vector<Material>& materials, const Part& part,
                 GeometryPlan& plan) {
  const tinygltf::Primitive& primitive = part.primitive.in(document);
  const auto has = [&](const std::string& name) { return primitive.attributes.contains(name); };
  plan.vertices += stored_vertex_count(document, primitive);
  plan.triangles += triangle_count(document, primitive);
  if (plan.vertices > kMaxVertices || plan.triangles > kMaxTriangles) {
    document.fail(part.place == kNoPlace ? part.primitive.pointer()
                                         : fmt::format("/nodes/{}", plan.places[part.place].node),
                  fmt::format("the scene's meshes hold more than {} vertices or triangles", kMaxVertices),
                  "split the scene or thin it out");
  }
  const Material& material = materials.at(part.material);
  plan.normals |= has("NORMAL");
  plan.colors |= has("COLOR_0");
  plan.tangents |= material.needs_tangents && has("TANGENT");
  plan.uv_sets |= material.uv_sets;
}

}  // namespace

void GeometryTally::report(std::vector<std::string>& warnings) const {
  const auto add = [&](std::size_t count, const char* text) {
    if (count > 0) warnings.push_back(fmt::format("{}: {}", text, count));
  };
  add(not_triangles, "primitives of points or lines, not rendered");
  add(empty, "meshes without primitives");
  add(no_positions, "primitives without POSITION, not rendered");
  add(degenerate, "triangles of zero area, dropped");
  add(left_over, "primitives whose last vertices make no whole triangle, dropped");
  add(flattened, "meshes flattened by a scale of zero");
  add(zero_normals, "vertices with a normal of zero length, shaded flat");
  add(no_coordinates, "primitives without the texture coordinates of their material, taken as 0");
  add(quantized, "primitives with integers where the file would have to use KHR_mesh_quantization");
  add(bright_colors, "primitives whose COLOR_0 leaves [0, 1], limited to that");
  add(morphed, "meshes with morph targets, shown at their default weights");
  add(skinned, "skinned meshes, shown in their rest pose");
}

GeometryPlan plan_gltf_geometry(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                                const std::vector<Material>& materials) {
  GeometryPlan plan;
  plan.places = list_mesh_places(document, nodes);

  // How often could each mesh be shared?
  std::vector<MeshParts> meshes(document.model.meshes.size());
  for (const NodeInstance& place : plan.places) {
    const tinygltf::Node& node = document.model.nodes[place.node];
    MeshParts& mesh = meshes[static_cast<std::size_t>(node.mesh)];
    if (!mesh.known) find_parts(document, static_cast<std::uint32_t>(node.mesh), materials, mesh);
    if (is_shareable(node, place.to_world)) ++mesh.shareable;
  }
  for (MeshParts& mesh : meshes) {
    const bool worth = mesh.triangles >= kMinShared && mesh.shareable > 1 &&
                       mesh.triangles > kMinSaved / (mesh.shareable - 1);
    if (!worth) continue;
    mesh.prototype = static_cast<std::uint32_t>(plan.prototypes.size());
    plan.prototypes.push_back({mesh.solid});
  }

  // Where does each go?
  for (std::uint32_t i = 0; i < plan.places.size(); ++i) {
    const NodeInstance& place = plan.places[i];
    const tinygltf::Node& node = document.model.nodes[place.node];
    const MeshParts& mesh = meshes[static_cast<std::size_t>(node.mesh)];
    const auto bake = [&](const std::vector<Part>& parts) {
      for (const Part& part : parts) {
        plan.baked.push_back({i, part.primitive, part.material});
        plan.tally.morphed += is_morphed(document, part.primitive, place.node);
      }
    };
    bake(mesh.emissive);
    if (mesh.prototype != kNoPlace && is_shareable(node, place.to_world))
      plan.instances.push_back({mesh.prototype, i});
    else
      bake(mesh.solid);
    plan.tally.not_triangles += mesh.not_triangles;
    plan.tally.no_positions += mesh.no_positions;
    plan.tally.quantized += mesh.quantized;
    plan.tally.empty += document.model.meshes[static_cast<std::size_t>(node.mesh)].primitives.empty();
    plan.tally.skinned += node.skin >= 0;
    plan.tally.flattened += place.to_world.determinant() == 0 && node.skin < 0;
  }
  std::ranges::stable_sort(plan.baked, {}, &Part::material);

  for (const Part& part : plan.baked) count_needs(document, materials, part, plan);
  for (const auto& prototype : plan.prototypes)
    for (const Part& part : prototype.parts) {
      count_needs(document, materials, part, plan);
      plan.tally.morphed += is_morphed(document, part.primitive, -1);
    }
  return plan;
}

}  // namespace photopic
