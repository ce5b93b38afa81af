#pragma once

#include <memory>

#include "core/fresnel_albedo.h"
#include "core/node_cosines.h"

namespace photopic {

/// FresnelAlbedo where roughness depends on the direction.
class GrainAlbedo {
 public:
  using Weights = FresnelAlbedo::Weights;

  /// Of one surface. (10 ms of one core)
  explicit GrainAlbedo(const AnisotropicGgx& ggx);

  /// The table for all: for surfaces on which roughness or grain vary. Integrated when first asked for (0.4 s
  /// of one core, 25 MB).
  static std::shared_ptr<const GrainAlbedo> of_all();

  /// Seen from w, w.z ≥ 0. @param ggx 1 ≥ alpha_x ≥ alpha_y ≥ kSmoothAlpha; the one surface's, if it is of
  /// one
  Weights directional(Vec3f w, const AnisotropicGgx& ggx) const;
  /// The cosine-weighted average over w.
  Weights average(const AnisotropicGgx& ggx) const;

 private:
  /// Numbers of nodes. Roughness: alpha_y. Grain: where alpha_x stands between alpha_y and 1; both by the
  /// eighth root of α, as albedo_roughness is. Azimuth: where the α that a direction sees stands between
  /// alpha_y and alpha_x.
  struct Axes {
    int roughnesses, grains, azimuths;
    NodeCosines cosines;
    int average_roughnesses, average_grains;  ///< of the averages
  };
  GrainAlbedo();
  /// @param ggx_at_nodes (roughness, of how many, grain, of how many)
  template <typename GgxAt>
  void fill(const GgxAt& ggx_at_nodes, int samples);
  Weights integrate_average(const AnisotropicGgx& ggx) const;
  std::size_t row(int roughness, int grain, int azimuth) const;

  Axes axes_;
  std::vector<Weights> directional_;   ///< [roughness][grain][azimuth][cos θ]
  std::vector<Weights> over_heights_;  ///< [roughness][grain][azimuth], averaged over cos θ
  std::vector<Weights> average_;       ///< [roughness][grain]; of `missing` the logarithm
};

}  // namespace photopic
