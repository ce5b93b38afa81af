#pragma once

#include <array>

#include "core/sampling.h"

namespace photopic {

/// KHR_materials_sheen: cloth fibres, the "Charlie" distribution with its fitted shadowing (Estevez & Kulla
/// 2017, "Production Friendly Microfacet Sheen BRDF"), of unit colour. The formulas give back up to three
/// times what arrives at grazing angles; a factor s(wo)·s(wi) ≤ 1 spares that and keeps them reciprocal.
class Sheen {
 public:
  Sheen(float roughness, Vec3f wo);

  /// f·cos θi [1/sr] for wi.z > 0.
  float evaluate(Vec3f wi) const;
  /// ∫ f·cos θi dω, at most 1.
  float albedo() const { return albedo_; }

  /// [1/sr]; denser towards the horizon, where smooth sheen is.
  float pdf(Vec3f wi) const { return 0.5f * kInvPi * spread_ * (1.0f + spread_) / sqr(wi.z + spread_); }
  Vec3f sample(Sample2d u) const;

 private:
  Vec3f wo_;
  float roughness_, albedo_, scale_;
  float spread_;
};

/// Tabulated factors s and the albedos they lead to.
class SheenAlbedo {
 public:
  /// The table, integrated when first asked for (0.2 s of one core).
  static const SheenAlbedo& table();

  struct Entry {
    float scale, albedo;
  };
  /// At cos θ in [0, 1] and (perceptual) roughness in [0, 1].
  Entry operator()(float cos_theta, float roughness) const;

 private:
  static constexpr int kCosines = 96, kRoughnesses = 32;
  using Row = std::array<Entry, kCosines>;
  SheenAlbedo();
  static Row row(float roughness);
  static Entry at(const Row& row, float cos_theta);

  std::array<Row, kRoughnesses> rows_;
};

}  // namespace photopic
