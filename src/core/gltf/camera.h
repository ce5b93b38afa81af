#pragma once

#include <vector>

#include "core/gltf/nodes.h"
#include "core/gltf_loader.h"

namespace photopic {

/// Sets scene.camera from the perspective camera that the options name, else the scene's first; its width
/// stays 0 where there is none. scene.origin must be known.
/// @throws InputError when a camera of that name is missing, or its place is degenerate
void load_gltf_camera(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                      const GltfOptions& options, Scene& scene);

}  // namespace photopic
