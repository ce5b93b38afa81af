#pragma once

namespace photopic {

/// The energy that one bounce off a rough GGX surface keeps, as the two factors of Schlick's Fresnel term:
/// albedo(F0, F90) = F0·scale + F90·bias (Karis 2013, "split sum"). What is missing from scale + bias = 1 is
/// the energy of further bounces, which Kulla & Conty 2017 give back. From a table that is integrated when
/// the program is built (60 ms of one core, which every start would take).
class GgxAlbedo {
 public:
  struct Factors {
    float missing;  ///< 1 − scale − bias, exact where it is tiny
    float bias;
    float scale() const { return 1.0f - missing - bias; }
  };

  /// Directional albedo factors at cos θ in [0, 1] and roughness = sqrt(α) in [0, 1].
  static Factors directional(float cos_theta, float roughness);
  /// Their cosine-weighted averages, 2∫ … μ dμ.
  static Factors average(float roughness);

  static constexpr int kCosines = 64, kRoughnesses = 32;  ///< of the axes of albedo_axes.h

 private:
  static const Factors kTable[kRoughnesses]
                             [kCosines + 1];  ///< generated; the last of each row is the average
};

}  // namespace photopic
