#pragma once

#include "core/bsdf/anisotropic_ggx.h"
#include "core/bsdf/bounce_cosines.h"
#include "core/bsdf/table_position.h"

namespace photopic {

/// BounceCosines of brushed surfaces from all sides. Roughness (alpha_y), grain (where alpha_x stands between
/// alpha_y and 1) and azimuth (where the α that a direction sees stands between the two) are axes of α's
/// fifth root. cos θ goes by its ratio to the α seen, so that neighbours on the other axes are alike.
class GrainTable {
 public:
  static constexpr int kRoughnesses = 20, kGrains = 22, kAzimuths = 12, kCosines = 36;
  static constexpr int kNodes = kRoughnesses * kGrains * kAzimuths * kCosines;

  /// @param numbers kLanes to a node; must outlive this
  explicit GrainTable(const char16_t* numbers) : numbers_(numbers) {}

  /// A surface's place on the axes of roughness and grain.
  struct SurfacePlace {
    AnisotropicGgx ggx{1.0f, 1.0f};
    float root_x = 1.0f, root_y = 1.0f;  ///< of its α
    SurfacePlace() = default;
    /// @param ggx 1 ≥ alpha_x ≥ alpha_y ≥ kSmoothAlpha
    explicit SurfacePlace(const AnisotropicGgx& ggx);
    TablePosition roughness(int size) const;
    TablePosition grain(int size) const;
  };
  /// On axes of so many nodes.
  static AnisotropicGgx ggx_at(int roughness, int roughnesses, int grain, int grains);

  /// @param w.z ≥ 0
  BounceCosines look_up(const SurfacePlace& place, Vec3f w) const;

  /// The numbers of a node, to be written into the table.
  static std::array<char16_t, kLanes> integrate(int node, const VisibleNormals& normals);

 private:
  const char16_t* numbers_;
};

}  // namespace photopic
