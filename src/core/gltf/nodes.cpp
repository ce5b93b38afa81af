#include "core/gltf/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace photopic {
namespace {

constexpr std::size_t kMaxShared = 1'000'000;  // visits beyond one a node, of nodes with several parents
constexpr int kOddDepth = 1000;
constexpr double kMatrixRounding = 1e-5;  // of exporters that multiply and invert in single precision

std::string node_pointer(int node) {
  return fmt::format("/nodes/{}", node);
}

Affine matrix_of(const GltfDocument& document, int index, const std::vector<double>& m) {
  const double off = std::max({std::abs(m[3]), std::abs(m[7]), std::abs(m[11]), std::abs(m[15] - 1)});
  if (!(off <= kMatrixRounding)) {
    document.fail(node_pointer(index) + "/matrix", "the last row is not 0 0 0 1",
                  "apply the transformation before exporting");
  }
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

bool is_hidden(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_node_visibility");
  return found != node.extensions.end() && found->second.Has("visible") &&
         !found->second.Get("visible").Get<bool>();
}

/// Depth first through all nodes, without recursion: chains may be as long as the file.
void check_cycles(const GltfDocument& document) {
  enum State : char { unseen, on_path, done };
  struct Step {
    int node;
    std::size_t child;
  };
  const auto& nodes = document.model.nodes;
  std::vector<State> state(nodes.size(), unseen);
  std::vector<Step> path;
  for (int root = 0; root < static_cast<int>(nodes.size()); ++root) {
    if (state[root] == unseen) path.push_back({root, 0}), state[root] = on_path;
    while (!path.empty()) {
      auto& [node, child] = path.back();
      if (child == nodes[node].children.size()) {
        state[node] = done;
        path.pop_back();
        continue;
      }
      const int next = nodes[node].children[child++];
      if (state[next] == on_path)
        document.fail(node_pointer(node) + "/children", fmt::format("node {} is its own ancestor", next),
                      "take it out of the children");
      if (state[next] == unseen) path.push_back({next, 0}), state[next] = on_path;
    }
  }
}

std::vector<int> scene_roots(const tinygltf::Model& model, int scene) {
  if (scene >= 0) return model.scenes[static_cast<std::size_t>(scene)].nodes;
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const auto& node : model.nodes) {
    for (const int child : node.children) is_child[child] = true;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

}  // namespace

Affine local_transform(const GltfDocument& document, int index) {
  const tinygltf::Node& node = document.model.nodes[index];
  if (!node.matrix.empty()) return matrix_of(document, index, node.matrix);
  Affine local;
  if (const auto& q = node.rotation; !q.empty()) {
    const auto turned = rotation(q[0], q[1], q[2], q[3]);
    if (!turned) document.fail(node_pointer(index) + "/rotation", "this quaternion is zero or too large");
    local = *turned;
  }
  if (!node.scale.empty()) {
    local.x = local.x * node.scale[0];
    local.y = local.y * node.scale[1];
    local.z = local.z * node.scale[2];
  }
  if (!node.translation.empty()) local.t = {node.translation[0], node.translation[1], node.translation[2]};
  return local;
}

std::vector<NodeInstance> walk_nodes(const GltfDocument& document, int scene,
                                     std::vector<std::string>& warnings) {
  check_cycles(document);
  const auto& nodes = document.model.nodes;
  std::vector<NodeInstance> found, pending;
  const auto push_reversed = [&](const std::vector<int>& children, const Affine& parent, int depth,
                                 bool visible) {
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      pending.push_back({*child, parent, depth, visible});
  };

  int deepest = 0;
  push_reversed(scene_roots(document.model, scene), Affine{}, 0, true);
  for (std::size_t visits = 0; !pending.empty(); ++visits) {
    NodeInstance instance = pending.back();
    pending.pop_back();
    const tinygltf::Node& node = nodes[instance.node];
    if (visits > nodes.size() + kMaxShared) {
      document.fail(node_pointer(instance.node),
                    "nodes with several parents multiply beyond a million instances",
                    "give each node one parent");
    }
    instance.to_world = instance.to_world * local_transform(document, instance.node);
    if (!is_finite(instance.to_world)) {
      document.fail(node_pointer(instance.node), "its place in the world is not finite",
                    "correct the scales of its parents");
    }
    instance.visible = instance.visible && !is_hidden(node);
    push_reversed(node.children, instance.to_world, instance.depth + 1, instance.visible);
    const bool has_light = node.extensions.contains(kPunctualLights);
    if (node.mesh >= 0 || node.camera >= 0 || has_light) found.push_back(instance);
    deepest = std::max(deepest, instance.depth);
  }
  if (deepest > kOddDepth) warnings.push_back(fmt::format("nodes lie up to {} levels deep", deepest));
  return found;
}

}  // namespace photopic
