#pragma once

#include <array>
#include <vector>

#include "core/bsdf/visible_normals.h"

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
    float missing = 0.0f;  ///< 1 − f0 − f90, exact where it is tiny; what is lost where F is 1 everywhere
    std::array<float, kNodes> rest{};

    void add(const Weights& other, float factor);
  };

  /// The weights of F(cos θ) itself.
  static Weights at(float cos_theta);

  /// Of one bounce, by integration over normals. @param wo in the grain's frame, wo.z > 0
  static Weights integrate(const VisibleNormals& normals, const AnisotropicGgx& ggx, Vec3f wo);

  /// The table for roughness alike in all directions, integrated when first asked for (40 ms of one core).
  static const FresnelAlbedo& table();

  /// At cos θ in [0, 1] and roughness √α in [0, 1].
  Weights directional(float cos_theta, float roughness) const;
  /// The cosine-weighted average over all directions.
  Weights average(float roughness) const;

 private:
  static constexpr int kRoughnesses = 32;
  FresnelAlbedo();
  std::vector<Weights> directional_;  ///< [roughness][cos θ]
  std::vector<Weights> average_;
};

}  // namespace photopic
