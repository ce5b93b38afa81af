#pragma once

#include <vector>

#include "core/gltf/nodes.h"

namespace photopic {

/// Every place where a mesh stands: the visible nodes with one, and of those with EXT_mesh_gpu_instancing all
/// their instances, as many as its attributes have elements, each translation × rotation × scale below the
/// node.
/// @throws InputError for quaternions of zero, for too many instances
std::vector<NodeInstance> list_mesh_places(const GltfDocument& document,
                                           const std::vector<NodeInstance>& nodes);

}  // namespace photopic
