#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/gltf/document.h"
#include "core/math.h"

namespace photopic {

using Mat4f = std::array<float, 16>;  ///< column by column

/// The elements of an accessor whose type is VEC2, VEC3, VEC4 or MAT4 as T says: floats, or integers as they
/// are or, if the accessor says so, normalised (glTF 2.0, section 3.6.2.2; quantised attributes as in
/// KHR_mesh_quantization). Strides and sparse substitutions are honoured. T is Vec2f, Vec3f, Vec4f or Mat4f.
/// @throws InputError when the type is another, a value is not finite, or its buffer has no bytes
template <typename T>
std::vector<T> read_elements(const GltfDocument& document, int accessor);

/// The elements of an accessor of vertex indices.
/// @throws InputError when the type is not an unsigned scalar
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor);

}  // namespace photopic
