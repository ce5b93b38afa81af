#pragma once

#include <vector>

#include "core/gltf/nodes.h"
#include "core/gltf_loader.h"

namespace photopic {

/// Sets scene.camera from the camera that the options name, else from the scene's first; where there is none,
/// one that frames the whole scene, with a warning. `extras` of a glTF camera may give "resolution"
/// ([width, height] in pixels), "aperture_radius" and "focus_distance" (thin lens [m], not scaled by nodes).
/// scene.geometry and scene.origin must be known.
/// @throws InputError when a camera of that name is missing, its place is degenerate or its extras are wrong
void load_gltf_camera(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                      const GltfOptions& options, Scene& scene);

}  // namespace photopic
