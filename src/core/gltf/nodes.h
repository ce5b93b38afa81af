#pragma once

#include <string>
#include <vector>

#include "core/affine.h"
#include "core/gltf/document.h"

namespace photopic {

/// The extension by which nodes carry lights.
inline constexpr const char* kPunctualLights = "KHR_lights_punctual";

/// A node of the scene with a mesh, a camera or a light, at one of the places where the scene graph puts it.
struct NodeInstance {
  int node;
  Affine to_world;
  int depth = 0;        ///< nodes above it
  bool visible = true;  ///< KHR_node_visibility, its own and its parents': else only its camera counts
};

/// The node's own matrix, or its translation × rotation × scale.
/// @throws InputError for a quaternion of zero, for a matrix whose last row is not 0 0 0 1 but for rounding
Affine local_transform(const GltfDocument& document, int node);

/// The scene's nodes, parents first, in the file's order.
/// Chains so long that they are hardly meant are told in `warnings`.
/// @param scene −1: every root is one of its nodes
/// @throws InputError on cycles, on graphs that multiply beyond all bounds, on transformations that are not
/// finite
std::vector<NodeInstance> walk_nodes(const GltfDocument& document, int scene,
                                     std::vector<std::string>& warnings);

}  // namespace photopic
