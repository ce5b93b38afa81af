#pragma once

#include <cstdint>
#include <vector>

#include "core/gltf/document.h"
#include "core/math.h"

namespace photopic {

/// The elements of a VEC3 accessor: floats, or integers as they are or, if the accessor says so, normalised
/// (glTF 2.0, section 3.6.2.2; quantised attributes as in KHR_mesh_quantization). Strides and sparse
/// substitutions are honoured.
/// @throws InputError when the type is another, a value is not finite, or its buffer has no bytes
std::vector<Vec3f> read_vec3(const GltfDocument& document, int accessor);

/// The elements of an accessor of vertex indices.
/// @throws InputError when the type is not an unsigned scalar
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor);

}  // namespace photopic
