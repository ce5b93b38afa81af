#pragma once

#include "core/bsdf/fresnel_albedo.h"
#include "core/lanes.h"

namespace photopic {

/// How one bounce off a rough surface spreads the cosine between the viewer and the normals it meets, as
/// quantiles. Between the nodes of a table these are what to interpolate (Read 1999, "Linear interpolation of
/// histograms"): a smooth surface's peak moves from one node's place to the next one's, while shares of fixed
/// intervals fade out here and in there.
struct BounceCosines {
  static constexpr int kParts = 13;  ///< between quantiles, of unequal shares: tails are long
  /// Of what is kept, the share below quantile k.
  static constexpr float level(int k) {
    const float t = static_cast<float>(k) / kParts;
    return t * t * (3.0f - 2.0f * t);
  }
  static constexpr int kSchlick = kParts + 1, kMissing = kParts + 2;

  /// Quantiles; [kSchlick]: the cosine whose Schlick weight is the mean; [kMissing]: √ of the share of light
  /// that is lost where F is 1.
  Lanes values{};

  static BounceCosines of(const VisibleNormals::Bounces& bounces);

  /// @param rest whether the rest's are wanted, too; they are most of the work
  FresnelAlbedo::Weights weights(bool rest = true) const;
};
static_assert(BounceCosines::kMissing == kLanes - 1);

}  // namespace photopic
