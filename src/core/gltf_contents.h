#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace photopic {

/// What a glTF file lists, whether a render uses it or not.
struct GltfContents {
  struct Named {
    std::string name;  ///< the object's, else that of a node which holds it
    std::string type;
  };
  std::size_t nodes = 0, meshes = 0, primitives = 0, materials = 0, animations = 0;
  std::vector<std::string> scenes;
  std::vector<Named> cameras;  ///< perspective, orthographic
  std::vector<Named> lights;   ///< KHR_lights_punctual: directional, point, spot
  std::vector<std::string> extensions_used, extensions_required;
};

struct GltfDocument;

GltfContents list_contents(const GltfDocument& document);

}  // namespace photopic
