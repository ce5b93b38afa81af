#pragma once

#include <array>

#include "core/math.h"

namespace photopic {

/// KHR_materials_sheen: cloth fibres, the "Charlie" distribution with its fitted shadowing (Estevez & Kulla
/// 2017, "Production Friendly Microfacet Sheen BRDF"), of unit colour.
class Sheen {
 public:
  Sheen(float roughness, Vec3f wo);

  /// f·cos θi [1/sr] for wi.z > 0.
  float evaluate(Vec3f wi) const;
  /// ∫ f·cos θi dω, at most 1.
  float albedo() const { return albedo_; }

  /// The same straight from the formulas, which may exceed 1 at grazing angles; evaluate() is scaled to spare
  /// that.
  static float integrate(float cos_theta, float roughness);

 private:
  Vec3f wo_;
  float roughness_, albedo_, scale_;
};

/// Tabulated Sheen::integrate.
class SheenAlbedo {
 public:
  static const SheenAlbedo& table();
  float operator()(float cos_theta, float roughness) const;

 private:
  static constexpr int kSize = 32;
  SheenAlbedo();
  std::array<std::array<float, kSize>, kSize> albedo_;  ///< [roughness][√cos θ], equal steps
};

}  // namespace photopic
