#pragma once

#include "core/lanes.h"

namespace photopic {

/// The energy that one bounce off a rough GGX surface keeps, as the two factors of Schlick's Fresnel term:
/// albedo(F0, F90) = F0·scale + F90·bias (Karis 2013, "split sum"). What is missing from scale + bias = 1 is
/// the energy of further bounces, which Kulla & Conty 2017 give back. From a table that is integrated when
/// the program is built (60 ms of one core, which every start would take).
class GgxAlbedo {
 public:
  template <typename T>
  struct BasicFactors {
    T missing;  ///< 1 − scale − bias, exact where it is tiny
    T bias;
    T scale() const { return 1.0f - missing - bias; }
  };
  using Factors = BasicFactors<float>;

  /// Directional albedo factors at cos θ in [0, 1] and roughness = sqrt(α) in [0, 1].
  template <typename T>
  static BasicFactors<T> directional(T cos_theta, T roughness);
  /// Their cosine-weighted averages, 2∫ … μ dμ.
  template <typename T>
  static BasicFactors<T> average(T roughness);

  static constexpr int kCosines = 64, kRoughnesses = 32;  ///< of the axes of albedo_axes.h

 private:
  /// Generated; the last of each row is the average.
  static const Factors kTable[kRoughnesses][kCosines + 1];

  template <typename T>
  struct Pair;
  static Pair<float> two_of(int row, int first);
  static Pair<Lanes> two_of(IntLanes row, IntLanes first);
  static Factors mean_of(int row);
  static BasicFactors<Lanes> mean_of(IntLanes row);
};

}  // namespace photopic
