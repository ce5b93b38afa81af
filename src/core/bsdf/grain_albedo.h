#pragma once

#include "core/bsdf/grain_table.h"

namespace photopic {

/// FresnelAlbedo of a surface whose roughness depends on the direction. From a table that is integrated when
/// the program is built (4 s of one core, 6 MB).
class GrainAlbedo {
 public:
  using Weights = FresnelAlbedo::Weights;

  /// Of no surface yet.
  GrainAlbedo() = default;
  /// @param ggx 1 ≥ alpha_x ≥ alpha_y ≥ kSmoothAlpha
  explicit GrainAlbedo(const AnisotropicGgx& ggx) : place_(ggx) {}

  /// Seen from w, w.z ≥ 0. @param w in the grain's frame @param rest whether the rest's weights are wanted
  Weights directional(Vec3f w, bool rest) const {
    return GrainTable(kDirectional).look_up(place_, w).weights(rest);
  }
  /// The cosine-weighted average over w.
  Weights average() const;

  /// Nodes of the averages: twice as dense as the table's.
  static constexpr int kRoughnesses = 2 * GrainTable::kRoughnesses - 1, kGrains = 2 * GrainTable::kGrains - 1;

 private:
  alignas(32) static const char16_t kDirectional[];      ///< generated; a GrainTable's numbers
  static const Weights kAverage[kRoughnesses][kGrains];  ///< generated; of `missing` the logarithm

  GrainTable::SurfacePlace place_;
};

}  // namespace photopic
