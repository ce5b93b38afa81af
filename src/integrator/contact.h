#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/prepared_scene.h"

namespace photopic {

/// A side of a surface, as a path meets it. From the back it leaves a solid, from the front it enters one.
struct Boundary {
  std::uint32_t material;
  bool from_inside;
};

/// What lies in one place with a surface that a ray meets: so close that rounding may decide which comes
/// first, or whether a ray that starts beside one starts beyond another. All of it is met at once.
struct Contact {
  static constexpr std::size_t kCapacity = 8;

  struct Face {
    Hit hit;  ///< with the distance of the surface that was met first
    Boundary boundary{};
    float depth = 0;  ///< along the normal of that surface, onwards from it [m]
    float error = 0;  ///< bound on the distance between the hit and the face's plane [m]
  };

  /// Faces of solids that lie on the way through, in order. Those that come to nothing are left out: out of a
  /// solid and into one of the same material.
  std::span<const Face> solids() const { return std::span(faces).first(count); }

  Face met{};  ///< what the ray hit
  std::array<Face, kCapacity> faces{};
  std::size_t count = 0;
  std::optional<Face> screen{};     ///< another surface in the place, which is seen instead of the solids'
  float near_end = 0, far_end = 0;  ///< depths where paths start that turn back or go through [m]
  bool overflowed = false;          ///< more surfaces than kCapacity: the rest is not seen
};

/// Whether anything lies in one place with a hit.
inline bool touches(const PreparedScene& scene, const Hit& hit) {
  return scene.shapes[hit.shape].touches && scene.touching[hit.triangle] > 0.0f;
}

/// @param direction of the ray, unit
Contact contact_at(const PreparedScene& scene, const Hit& hit, Vec3f direction);

}  // namespace photopic
