#include "core/gltf/solid_glass.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/gltf/primitive.h"

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

/// Vertices at one place count as one: exporters split them where normals or coordinates differ.
class Welder {
 public:
  std::uint32_t operator()(Vec3f p) {
    const auto next = static_cast<std::uint32_t>(places_.size());
    return places_.try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, next).first->second;  // −0 is 0
  }

 private:
  std::map<std::tuple<float, float, float>, std::uint32_t> places_;
};

/// Each edge is run through as often one way as the other.
bool is_closed(const GltfDocument& document, std::uint32_t mesh) {
  Welder weld;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  const auto& primitives = document.model.meshes[mesh].primitives;
  for (std::uint32_t i = 0; i < primitives.size(); ++i) {
    if (!is_drawn(primitives[i])) continue;
    const PrimitiveRef ref{mesh, i};
    const auto positions = read_morphed<Vec3f>(document, ref, -1, "POSITION");
    for_each_triangle(document, ref, [&](const Triangle& t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = weld(positions[t[k]]), b = weld(positions[t[(k + 1) % 3]]);
        if (a != b) balance[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    });
  }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

}  // namespace

void make_closed_glass_solid(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                             Scene& scene) {
  const auto& model = document.model;
  std::set<std::uint32_t> meshes;
  for (const NodeInstance& node : nodes)
    if (const int mesh = model.nodes[node.node].mesh; mesh >= 0)
      meshes.insert(static_cast<std::uint32_t>(mesh));

  std::map<std::size_t, int> open_mesh;  // of each undecided material that is used; −1: none
  for (const std::uint32_t mesh : meshes) {
    std::set<std::size_t> glasses;
    for (const tinygltf::Primitive& primitive : model.meshes[mesh].primitives) {
      const auto material = static_cast<std::size_t>(primitive.material);
      if (primitive.material >= 0 && is_drawn(primitive) &&
          is_undecided(model.materials[material], scene.materials[material]))
        glasses.insert(material);
    }
    const int open = glasses.empty() || is_closed(document, mesh) ? -1 : static_cast<int>(mesh);
    for (const std::size_t material : glasses) {
      int& known = open_mesh.try_emplace(material, -1).first->second;
      known = std::max(known, open);
    }
  }
  for (const auto& [material, mesh] : open_mesh) {
    scene.materials[material].thin_walled = mesh >= 0;
    if (mesh >= 0)
      scene.warnings.push_back(fmt::format("the glass \"{}\" stays thin-walled: /meshes/{} is not closed",
                                           scene.materials[material].name, mesh));
  }
}

}  // namespace photopic
