#pragma once

#include <vector>

#include "core/math.h"

namespace photopic {

class Environment;
struct Scene;

/// What shines from beyond a scene: the tiles of its environment, then its directional lights.
struct Sky {
  /// The environment stays the scene's.
  explicit Sky(const Scene& scene);

  const Environment* environment;    ///< or none
  std::vector<Vec3f> directions;     ///< to the directional lights, unit
  std::vector<double> illuminances;  ///< by each of them, of a surface that faces it [lx]

  std::size_t tiles() const;
  bool empty() const { return !environment && directions.empty(); }
  /// ∫ L dω of each tile and light [lx]
  std::vector<double> fluxes() const;
};

}  // namespace photopic
