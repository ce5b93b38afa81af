#pragma once

#include <array>
#include <vector>

#include "core/math.h"

namespace photopic {

/// The energy that one bounce off a rough GGX surface keeps, for Fresnel terms of any shape. A term is
/// written as Schlick's through its values at normal and grazing incidence, plus a rest that is linear in cos
/// θ between nodes: F(c) = f0·(1 − w(c)) + f90·w(c) + Σ rest_k·hat_k(c). The albedo is then a weighted sum of
/// f0, f90 and rest_k; this table holds the weights.
class FresnelAlbedo {
 public:
  static constexpr int kNodes = 11;  ///< between 0 and 1, where the rest is 0
  /// cos θ of node k.
  static float node(int k) { return static_cast<float>(k + 1) / (kNodes + 1); }

  struct Weights {
    float f0 = 0.0f, f90 = 0.0f;
    std::array<float, kNodes> rest{};

    float total() const { return f0 + f90; }  ///< the albedo where F is 1 everywhere
    void add(const Weights& other, float factor);
  };

  /// The weights of F(cos θ) itself.
  static Weights at(float cos_theta);

  /// The table for roughness alike in all directions, and the one for AnisotropicGgx::of; each integrated
  /// when first asked for (30 ms; 0.4 s of one core).
  static const FresnelAlbedo& isotropic();
  static const FresnelAlbedo& anisotropic();

  /// Seen from w, w.z ≥ 0. @param roughness √α, in [0, 1]
  Weights directional(Vec3f w, float roughness, float strength) const;
  /// The cosine-weighted average over w.
  Weights average(float roughness, float strength) const;

 private:
  struct Size {
    int roughness, strength, azimuth, cosine;
  };
  explicit FresnelAlbedo(Size size);
  std::size_t entry(int roughness, int strength, int azimuth, int cosine) const;
  Weights average_of(int roughness, int strength) const;

  Size size_;
  std::vector<Weights> directional_, average_;
};

}  // namespace photopic
