#pragma once

#include "core/gltf/json_place.h"

/// What rules of single members cannot say. The document has passed those.
namespace photopic {

/// Views inside their buffers, accessors and their sparse parts inside their views.
/// @throws InputError
void check_bytes(const JsonPlace& root);

/// Attributes of one primitive: types by their names, equal counts; morph targets and weights; instances;
/// skins.
/// @throws InputError
void check_meshes(const JsonPlace& root);

/// Cameras, lights and images: members that depend on each other. Lists of nodes: none twice. Materials and
/// lights: the spectra in their `extras`.
/// @throws InputError
void check_objects(const JsonPlace& root);

}  // namespace photopic
