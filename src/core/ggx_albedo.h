#pragma once

#include <array>

namespace photopic {

/// The energy that one bounce off a rough GGX surface keeps, as the two factors of Schlick's Fresnel term:
/// albedo(F0, F90) = F0·scale + F90·bias (Karis 2013, "split sum"). What is missing from scale + bias = 1 is
/// the energy of further bounces, which Kulla & Conty 2017 give back.
class GgxAlbedo {
 public:
  struct Factors {
    float missing;  ///< 1 − scale − bias, exact where it is tiny
    float bias;
    float scale() const { return 1.0f - missing - bias; }
  };

  /// The table, integrated once when first asked for (10 ms of one core).
  static const GgxAlbedo& table();

  /// Directional albedo factors at cos θ in [0, 1] and roughness = sqrt(α) in [0, 1].
  Factors directional(float cos_theta, float roughness) const;
  /// Their cosine-weighted averages, 2∫ … μ dμ.
  Factors average(float roughness) const;

 private:
  static constexpr int kCosines = 64, kRoughnesses = 32;  ///< of the axes of albedo_axes.h
  GgxAlbedo();
  std::array<std::array<Factors, kCosines>, kRoughnesses> directional_;
  std::array<Factors, kRoughnesses> average_;
};

}  // namespace photopic
