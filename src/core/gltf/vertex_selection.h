#pragma once

#include <vector>

#include "core/affine.h"
#include "core/gltf/primitive.h"

namespace photopic {

/// How the vertices of a part come to where the geometry keeps them.
struct VertexMap {
  Affine whole;
  std::vector<Affine> of_vertex;  ///< of skinned parts

  const Affine& operator[](std::size_t i) const { return of_vertex.empty() ? whole : of_vertex[i]; }
  void translate(Vec3d by) {
    whole.t = whole.t + by;
    for (Affine& m : of_vertex) m.t = m.t + by;
  }
};

/// The vertices of a primitive that are stored: all, or, where it has fewer indices than vertices (exporters
/// let many primitives share one long list), those that it uses.
class VertexSelection {
 public:
  VertexSelection(const GltfDocument& document, const PrimitiveRef& ref) {
    const std::size_t vertices = vertex_count(document, ref.in(document));
    if (stored_vertex_count(document, ref.in(document)) == vertices) return;
    place_.assign(vertices, kUnused);
    for (const std::uint32_t index : read_checked_indices(document, ref)) place_[index] = 0;
    std::uint32_t next = 0;
    for (std::uint32_t& place : place_)
      if (place != kUnused) place = next++;
  }

  std::uint32_t place_of(std::uint32_t vertex) const { return place_.empty() ? vertex : place_[vertex]; }

  /// Calls visit(place, vertex) for those of `count` vertices that are stored.
  template <typename Visit>
  void for_each(std::size_t count, const Visit& visit) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (place_.empty())
        visit(i, i);
      else if (place_[i] != kUnused)
        visit(place_[i], i);
    }
  }

 private:
  static constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> place_;  ///< of each vertex; empty: all are stored as they stand
};

}  // namespace photopic
