#pragma once

#include <optional>

#include "core/affine.h"
#include "core/gltf/primitive.h"

namespace photopic {

/// Skins in their rest pose: joints stand where the file's nodes do.
class SkinPoses {
 public:
  explicit SkinPoses(const GltfDocument& document) : document_(document) {}

  /// Of each vertex, what brings it to the world: the mean of its joints' matrices (world matrix × inverse
  /// bind matrix) by its weights, whatever the mesh's own node is (glTF 2.0, section 3.7.3.3). Empty for
  /// primitives without JOINTS_0 and WEIGHTS_0.
  /// @throws InputError for joints and matrices that are not there
  std::vector<Affine> vertex_transforms(int skin, const PrimitiveRef& ref);

 private:
  const std::vector<Affine>& joint_matrices(int skin);
  Affine to_world(int node);

  const GltfDocument& document_;
  std::vector<std::vector<Affine>> matrices_;  ///< of each skin that was asked for
  std::vector<int> parent_;                    ///< of each node, −1: none
  std::vector<std::optional<Affine>> world_;   ///< of each node that was asked for, and its parents
};

}  // namespace photopic
