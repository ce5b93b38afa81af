#pragma once

#include <vector>

#include "core/gltf/nodes.h"
#include "core/scene.h"

namespace photopic {

/// Blender writes all glass thin-walled, KHR_materials_transmission without KHR_materials_volume. Makes such
/// materials solid whose meshes are all closed: every edge has its two triangles, turned alike. A material
/// that says itself which it is (a volume, or "solid" in its extras) stays as it is; one that an open mesh
/// has, too, is told in the warnings, and so is that there is none to decide on.
/// @param nodes of the scene
/// @throws InputError for indices beyond a mesh's vertices
void make_closed_glass_solid(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                             Scene& scene);

/// Tells, in one line for each material, where solid glass does not enclose a volume: its mesh has holes or
/// faces that are turned unlike their neighbours, or all of it looks inwards (its volume, less that of its
/// hollows, is negative) and lies in no other body of that glass, as a bubble would; and where alpha may
/// leave it uncovered. The textures must have been loaded.
void warn_of_unsound_glass(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                           Scene& scene);

}  // namespace photopic
