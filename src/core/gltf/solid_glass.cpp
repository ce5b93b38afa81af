#include "core/gltf/solid_glass.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/gltf/closure.h"
#include "core/gltf/instancing.h"
#include "core/gltf/material.h"
#include "core/surface.h"

namespace photopic {
namespace {

bool is_drawn(const tinygltf::Primitive& primitive) {
  return draws_triangles(primitive) && primitive.attributes.contains("POSITION");
}

/// Whether a material leaves open which of the two it is.
bool is_undecided(const tinygltf::Material& source, const Material& material) {
  const bool said = source.extensions.contains("KHR_materials_volume") ||
                    (source.extras.IsObject() && source.extras.Has("solid"));
  return material.transmission > 0.0f && material.thin_walled && !said;
}

/// The meshes of nodes, each once. @param hidden nodes that are not shown, too
std::set<std::uint32_t> meshes_of(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                                  bool hidden) {
  std::set<std::uint32_t> meshes;
  for (const NodeInstance& node : nodes)
    if (const int mesh = document.model.nodes[node.node].mesh; mesh >= 0 && (hidden || node.visible))
      meshes.insert(static_cast<std::uint32_t>(mesh));
  return meshes;
}

MeshSurface surface_of(const GltfDocument& document, const std::vector<PrimitiveRef>& primitives) {
  MeshSurface surface;
  for (const PrimitiveRef& ref : primitives) surface.add(document, ref);
  return surface;
}

/// Of all that is drawn of a mesh.
Closure closure_of(const GltfDocument& document, std::uint32_t mesh) {
  std::vector<PrimitiveRef> drawn;
  const auto& primitives = document.model.meshes[mesh].primitives;
  for (std::uint32_t i = 0; i < primitives.size(); ++i)
    if (is_drawn(primitives[i])) drawn.push_back({mesh, i});
  return surface_of(document, drawn).closure();
}

/// The part of a mesh that is of one solid glass.
struct GlassBody {
  std::uint32_t mesh;
  std::size_t material;
  Closure closure;
  Boxd box;       ///< as the mesh has it
  Boxd placed{};  ///< in the world, where the mesh stands first
};

/// What a glass leaves open another material of its mesh may close: a label, say.
void find_bodies(const GltfDocument& document, std::uint32_t mesh, const std::vector<bool>& encloses,
                 std::vector<GlassBody>& bodies) {
  std::map<std::size_t, std::vector<PrimitiveRef>> glasses;
  const auto& primitives = document.model.meshes[mesh].primitives;
  for (std::uint32_t i = 0; i < primitives.size(); ++i) {
    const auto material = static_cast<std::size_t>(primitives[i].material);
    if (primitives[i].material >= 0 && encloses[material] && is_drawn(primitives[i]))
      glasses[material].push_back({mesh, i});
  }
  std::optional<Closure> whole;
  for (const auto& [material, own] : glasses) {
    const MeshSurface surface = surface_of(document, own);
    Closure closure = surface.closure();
    if (closure == Closure::open && own.size() < primitives.size()) {
      if (!whole) whole = closure_of(document, mesh);
      closure = *whole;
    }
    bodies.push_back({mesh, material, closure, surface.box()});
  }
}

bool holds(const Boxd& outer, const Boxd& inner) {
  const auto ordered = [](Vec3d a, Vec3d b) { return a.x <= b.x && a.y <= b.y && a.z <= b.z; };
  return ordered(outer.low, inner.low) && ordered(inner.high, outer.high);
}

/// What looks inwards in a body of the same glass is a bubble in it. Their boxes decide.
/// @param bodies by rising mesh
void drop_bubbles(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                  std::vector<GlassBody>& bodies) {
  if (std::ranges::count(bodies, Closure::inside_out, &GlassBody::closure) == 0) return;
  std::map<std::size_t, std::vector<Boxd>> closed;  // by glass, in the world
  for (const NodeInstance& place : list_mesh_places(document, nodes)) {
    const auto mesh = static_cast<std::uint32_t>(document.model.nodes[place.node].mesh);
    for (GlassBody& body : std::ranges::equal_range(bodies, mesh, {}, &GlassBody::mesh)) {
      const Boxd placed = image_of(body.box, place.to_world);
      if (body.closure == Closure::closed) closed[body.material].push_back(placed);
      if (body.placed.is_empty()) body.placed = placed;
    }
  }
  std::erase_if(bodies, [&](const GlassBody& body) {
    return body.closure == Closure::inside_out &&
           std::ranges::any_of(closed[body.material],
                               [&](const Boxd& box) { return holds(box, body.placed); });
  });
}

struct FaultyMeshes {
  std::uint32_t first;
  std::size_t count = 0;
};

std::string quoted(const std::string& name) {
  return fmt::format("\"{}\"", name.substr(0, 60));
}

/// A ray that passes a wall where alpha does not cover it is not in the glass for what it meets next.
void warn_of_uncovered_glass(const std::vector<GlassBody>& bodies, Scene& scene) {
  std::set<std::size_t> glasses;
  for (const GlassBody& body : bodies)
    if (Surface(scene.materials[body.material]).partly_covers) glasses.insert(body.material);
  for (const std::size_t glass : glasses)
    scene.warnings.push_back(fmt::format(
        "the solid glass {} has alpha, and what passes an uncovered wall does not enter it, which "
        "makes its light wrong: set alphaMode to OPAQUE, transmission lets light through already",
        quoted_name(scene, glass)));
}

}  // namespace

void make_closed_glass_solid(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                             Scene& scene) {
  const auto& model = document.model;
  std::map<std::size_t, int> open_mesh;  // of each undecided material that is used; −1: none
  for (const std::uint32_t mesh : meshes_of(document, nodes, true)) {
    std::set<std::size_t> glasses;
    for (const tinygltf::Primitive& primitive : model.meshes[mesh].primitives) {
      const auto material = static_cast<std::size_t>(primitive.material);
      if (primitive.material >= 0 && is_drawn(primitive) &&
          is_undecided(model.materials[material], scene.materials[material]))
        glasses.insert(material);
    }
    const bool is_open = !glasses.empty() && closure_of(document, mesh) == Closure::open;
    const int open = is_open ? static_cast<int>(mesh) : -1;
    for (const std::size_t material : glasses) {
      int& known = open_mesh.try_emplace(material, -1).first->second;
      known = std::max(known, open);
    }
  }
  if (open_mesh.empty()) {
    const bool any = std::ranges::any_of(
        scene.materials, [](float t) { return t > 0.0f; }, &Material::transmission);
    scene.warnings.push_back(fmt::format(
        "--solid-glass has no effect: {}",
        any ? "all glass of the meshes says itself whether it is solid" : "no material transmits"));
  }
  for (const auto& [material, mesh] : open_mesh) {
    scene.materials[material].thin_walled = mesh >= 0;
    if (mesh >= 0)
      scene.warnings.push_back(fmt::format("the glass \"{}\" stays thin-walled: /meshes/{} is not closed",
                                           scene.materials[material].name, mesh));
  }
}

void warn_of_unsound_glass(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                           Scene& scene) {
  std::vector<bool> encloses;
  for (const Material& m : scene.materials)
    encloses.push_back(m.transmission > 0.0f && !m.thin_walled && Surface(m).encloses);
  if (std::ranges::count(encloses, true) == 0) return;

  std::vector<GlassBody> bodies;
  for (const std::uint32_t mesh : meshes_of(document, nodes, false))
    find_bodies(document, mesh, encloses, bodies);
  warn_of_uncovered_glass(bodies, scene);
  drop_bubbles(document, nodes, bodies);
  std::map<std::pair<std::size_t, Closure>, FaultyMeshes> faults;  // by glass and by what is wrong with it
  for (const GlassBody& body : bodies)
    if (body.closure != Closure::closed)
      ++faults.try_emplace({body.material, body.closure}, FaultyMeshes{body.mesh}).first->second.count;
  for (const auto& [glass, meshes] : faults) {
    const auto& [material, closure] = glass;
    const bool open = closure == Closure::open;
    const std::string& mesh = document.model.meshes[meshes.first].name;
    scene.warnings.push_back(fmt::format(
        "the solid glass {} is {} in /meshes/{}{}{}: {}", quoted_name(scene, material),
        open ? "not closed" : "inside out", meshes.first, mesh.empty() ? "" : " " + quoted(mesh),
        meshes.count > 1 ? fmt::format(" and {} more", meshes.count - 1) : "",
        open ? "close it, or make it thin-walled (\"solid\": false in the material's extras)"
             : "its faces look inwards; turn them (Blender: Mesh, Normals, Recalculate Outside)"));
  }
}

}  // namespace photopic
