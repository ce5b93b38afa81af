#pragma once

#include <string>
#include <vector>

#include "core/gltf/document.h"
#include "core/math.h"

namespace photopic {

/// p ↦ x·p.x + y·p.y + z·p.z + t.
struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t;

  Vec3d vector(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d point(Vec3d p) const { return vector(p) + t; }
  double determinant() const { return dot(x, cross(y, z)); }

  /// Carries normals: the cofactor matrix, |det| times the inverse transpose, which lives on where there is
  /// no inverse.
  Vec3d normal(Vec3d n) const {
    const Vec3d image = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return determinant() < 0 ? -image : image;
  }

  friend Affine operator*(const Affine& a, const Affine& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.t)};
  }
};

/// The extension by which nodes carry lights.
inline constexpr const char* kPunctualLights = "KHR_lights_punctual";

/// A node of the scene with a mesh, a camera or a light, at one of the places where the scene graph puts it.
struct NodeInstance {
  int node;
  Affine to_world;
  int depth = 0;  ///< nodes above it
};

/// The default scene's nodes (else the first scene's, else every root), parents first, in the file's order.
/// Chains so long that they are hardly meant are told in `warnings`.
/// @throws InputError on cycles, on graphs that multiply beyond all bounds, on transformations that are not
/// finite
std::vector<NodeInstance> walk_nodes(const GltfDocument& document, std::vector<std::string>& warnings);

}  // namespace photopic
