#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/gltf/nodes.h"
#include "core/gltf/primitive.h"
#include "core/scene.h"

namespace photopic {

/// What was mended or left out, counted for one warning each.
struct GeometryTally {
  std::size_t not_triangles = 0, no_positions = 0, degenerate = 0, left_over = 0, flattened = 0,
              zero_normals = 0, no_coordinates = 0, morphed = 0, skinned = 0, empty = 0, quantized = 0,
              bright_colors = 0;

  void report(std::vector<std::string>& warnings) const;
};

inline constexpr std::uint32_t kNoPlace = ~0u;

/// A primitive to be read: at a place in the world, or (kNoPlace) as its mesh has it.
struct Part {
  std::uint32_t place;  ///< index into GeometryPlan::places
  PrimitiveRef primitive;
  std::uint32_t material;
};

/// Which meshes are baked into the world and which are kept once with instances, and what must be stored.
struct GeometryPlan {
  std::vector<NodeInstance> places;  ///< of meshes
  std::vector<Part> baked;           ///< ordered by material
  struct PrototypeParts {
    std::vector<Part> parts;
  };
  std::vector<PrototypeParts> prototypes;
  struct PlacedPrototype {
    std::uint32_t prototype, place;
  };
  std::vector<PlacedPrototype> instances;

  std::size_t vertices = 0, triangles = 0;  ///< of all parts
  bool normals = false, tangents = false, colors = false;
  std::uint8_t uv_sets = 0;  ///< as Material::uv_sets

  GeometryTally tally;
};

/// A mesh is shared by instances where that saves more than 100,000 triangles and it has at least 8 (measured
/// with Embree 3.13: an instance takes 420 bytes, a triangle 85). Its emissive primitives are baked all the
/// same, so that lights are triangles of the world; so are skinned and morphed nodes, and those whose scales
/// are extreme.
/// @param materials glTF's, and its default after them
/// @throws InputError when the scene holds too many vertices or triangles
GeometryPlan plan_gltf_geometry(const GltfDocument& document, const std::vector<NodeInstance>& nodes,
                                const std::vector<Material>& materials);

}  // namespace photopic
