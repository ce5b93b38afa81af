#pragma once

#include <string>
#include <vector>

#include "core/gltf/document.h"

namespace photopic {

/// Warns of `extras` that mean something here but stand where nothing reads them: on a node or a mesh, where
/// Blender puts an object's custom properties, or on the right object in other letters ("Conductor",
/// "apertureRadius", "emission_spectrun"). Once for each key and kind of object. Other keys are others'.
void warn_of_stray_extras(const GltfDocument& document, std::vector<std::string>& warnings);

}  // namespace photopic
