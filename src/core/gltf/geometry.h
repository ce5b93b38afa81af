#pragma once

#include <vector>

#include "core/gltf/nodes.h"
#include "core/scene.h"

namespace photopic {

/// Bakes every instance's triangles into scene.geometry, sets scene.origin to the middle of their bounding
/// box and adds what was left out to scene.warnings. Shape::material is glTF's index; primitives without one
/// get the number of glTF materials, where the caller puts the default.
/// @throws InputError
void load_gltf_geometry(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                        Scene& scene);

}  // namespace photopic
