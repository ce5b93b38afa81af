#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/gltf/accessor.h"

namespace photopic {

using Triangle = std::array<std::uint32_t, 3>;

/// A primitive of a mesh, by its place in the file.
struct PrimitiveRef {
  std::uint32_t mesh, index;

  const tinygltf::Primitive& in(const GltfDocument& document) const {
    return document.model.meshes[mesh].primitives[index];
  }
  std::string pointer() const;
};

bool draws_triangles(const tinygltf::Primitive& primitive);

/// Whole triangles that the primitive describes, of zero area or not. It must have POSITION.
std::size_t triangle_count(const GltfDocument& document, const tinygltf::Primitive& primitive);
std::size_t vertex_count(const GltfDocument& document, const tinygltf::Primitive& primitive);

/// Vertices to make room for: not those that a primitive with fewer indices than vertices leaves to others.
std::size_t stored_vertex_count(const GltfDocument& document, const tinygltf::Primitive& primitive);

/// Whether vertices are left over after the last whole triangle.
bool has_left_over(const GltfDocument& document, const tinygltf::Primitive& primitive);

/// Corner numbers of triangle i (glTF 2.0, section 3.7.2.1): strips alternate their winding, fans share
/// corner 0.
Triangle corners_of(const tinygltf::Primitive& primitive, std::uint32_t i);

/// Empty for primitives without indices.
/// @throws InputError for indices beyond the primitive's vertices
std::vector<std::uint32_t> read_checked_indices(const GltfDocument& document, const PrimitiveRef& ref);

/// Calls visit(Triangle) for every triangle of a list, strip or fan, with indices into the primitive's
/// vertices.
/// @throws InputError for indices beyond them
template <typename Visit>
void for_each_triangle(const GltfDocument& document, const PrimitiveRef& ref, const Visit& visit) {
  const std::vector<std::uint32_t> indices = read_checked_indices(document, ref);
  const tinygltf::Primitive& primitive = ref.in(document);
  const auto count = static_cast<std::uint32_t>(triangle_count(document, primitive));
  for (std::uint32_t i = 0; i < count; ++i) {
    Triangle triangle = corners_of(primitive, i);
    if (!indices.empty())
      for (std::uint32_t& corner : triangle) corner = indices[corner];
    visit(triangle);
  }
}

/// An attribute as the file has it, an element a vertex; empty where there is none. T as in read_elements.
template <typename T>
std::vector<T> read_attribute(const GltfDocument& document, const PrimitiveRef& ref, const char* name);

/// COLOR_0 as linear RGBA, limited to [0, 1] (glTF 2.0, section 3.7.2.1); empty where there is none.
/// @param limited becomes true where that changed a value
std::vector<Vec4f> read_colors(const GltfDocument& document, const PrimitiveRef& ref, bool& limited);

/// POSITION, NORMAL or (T = Vec4f, whose w stays) TANGENT with the morph targets' displacements by their
/// default weights: the node's, else the mesh's, else 0 (glTF 2.0, section 3.7.2.2).
/// @param node −1: none
template <typename T>
std::vector<T> read_morphed(const GltfDocument& document, const PrimitiveRef& ref, int node,
                            const char* name);

/// Whether the primitive's weights, as read_morphed takes them, displace it.
bool is_morphed(const GltfDocument& document, const PrimitiveRef& ref, int node);

}  // namespace photopic
