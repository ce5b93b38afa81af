#pragma once

#include <vector>

namespace photopic {

/// The share of light that one bounce off, or one passage through, a rough dielectric interface keeps (both
/// together; GGX, exact Fresnel terms). What is missing goes on between the microfacets; glass BSDFs give it
/// back by dividing by this share, after Turquin 2019 ("Practical multiple scattering compensation for
/// microfacet models").
class GlassAlbedo {
 public:
  struct Range {
    float low, high;
  };

  /// Integrates the table: about 30 ms for one index and one roughness, five- to tenfold for a range of
  /// either.
  /// @param ior of the glass, over that of what is outside; > 1 @param roughness √α, in [0, 1]
  GlassAlbedo(Range ior, Range roughness);

  /// @param cos_theta of the viewer to the normal on his side, in [0, 1] @param inside whether he is in the
  /// glass
  float operator()(float cos_theta, float roughness, float ior, bool inside) const;

 private:
  std::size_t entry(int ior, int roughness, bool inside, int cosine) const;
  float row(int ior, int roughness, bool inside, float cos_theta) const;

  Range ior_, roughness_;
  int iors_, roughnesses_;  ///< numbers of nodes, equally far apart
  std::vector<float> share_;
};

}  // namespace photopic
