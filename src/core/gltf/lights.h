#pragma once

#include <vector>

#include "core/gltf/emission.h"
#include "core/gltf/nodes.h"

namespace photopic {

/// Fills scene.punctual_lights from KHR_lights_punctual: color's luminance × intensity ×
/// options.punctual_scale, at the nodes' places, not scaled by them. What is ignored goes to scene.warnings.
/// @throws InputError
void load_gltf_lights(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                      const GltfOptions& options, GltfEmissions& emissions, Scene& scene);

/// The environment that the options name; else, where nothing of the scene emits light, an overcast sky, with
/// a warning.
/// @throws InputError
void load_gltf_environment(const GltfDocument& document, const GltfOptions& options, GltfEmissions& emissions,
                           Scene& scene);

}  // namespace photopic
