#pragma once

#include "core/anisotropic_ggx.h"
#include "core/fresnel_albedo.h"

namespace photopic {

/// FresnelAlbedo where roughness depends on the direction: what the isotropic surface of the roughness that a
/// direction sees would keep, and a table of how far the truth is from it.
class GrainAlbedo {
 public:
  using Weights = FresnelAlbedo::Weights;

  /// The table, integrated when first asked for (0.3 s of one core).
  static const GrainAlbedo& table();

  /// Seen from w, w.z ≥ 0. @param ggx 1 ≥ alpha_x ≥ alpha_y ≥ kSmoothAlpha
  Weights directional(Vec3f w, const AnisotropicGgx& ggx) const;
  /// The cosine-weighted average over w.
  Weights average(const AnisotropicGgx& ggx) const;

 private:
  GrainAlbedo();
  Weights average_of(const AnisotropicGgx& ggx) const;

  std::vector<Weights> correction_;  ///< [roughness][grain][azimuth][cos θ]
  std::vector<Weights> average_;     ///< [roughness][grain]; of `missing` the logarithm
};

}  // namespace photopic
