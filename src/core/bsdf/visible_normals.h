#pragma once

#include <vector>

#include "core/bsdf/anisotropic_ggx.h"

namespace photopic {

/// Points for the integrals behind albedo tables: normals of a GGX surface in proportion to what a viewer
/// sees of them, steep ones, where light is lost, more often and weighed less. They stand on a golden-ratio
/// (Kronecker) lattice, which at 1024 points leaves errors of 5e-4 at most where Sobol' points leave 1.2e-3.
class VisibleNormals {
 public:
  /// @param count a multiple of 16
  explicit VisibleNormals(int count);

  int count() const { return kLanes * static_cast<int>(weight_.size()); }
  /// Of point i: what to give sample_visible(), and its share of the mean.
  Sample2d sample(int i) const { return {at(turn_, i), 1.0f - at(rise_, i)}; }
  float weight(int i) const { return at(weight_, i); }

  /// One bounce off a surface where F = 1.
  struct Bounces {
    std::vector<Lanes> cosine;  ///< between wo and the normal
    std::vector<Lanes> kept;    ///< of each point's share: G2/G1, nothing below the horizon
    float missing = 0.0f;       ///< 1 − Σ kept, exact where it is tiny

    /// Calls f(cosine, kept) for each point.
    template <typename F>
    void for_each(const F& f) const {
      for (std::size_t i = 0; i < kept.size(); ++i)
        for (int lane = 0; lane < kLanes; ++lane) f(cosine[i][lane], kept[i][lane]);
    }
  };
  /// @param wo unit, wo.z > 0
  Bounces bounces(const AnisotropicGgx& ggx, Vec3f wo) const;

 private:
  static float at(const std::vector<Lanes>& values, int i) {
    return values[static_cast<std::size_t>(i / kLanes)][i % kLanes];
  }

  std::vector<Lanes> turn_, cos_, sin_;  ///< first coordinate, and the azimuth that it is
  std::vector<Lanes> rise_, weight_;     ///< 1 − second coordinate
};

}  // namespace photopic
