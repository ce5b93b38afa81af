#include "core/bsdf/ggx_albedo.h"

#include <cstring>

#include "core/bsdf/albedo_axes.h"

namespace photopic {
namespace {

template <typename Factors, typename T>
Factors lerp(Factors a, Factors b, T t) {
  return {a.missing + (b.missing - a.missing) * t, a.bias + (b.bias - a.bias) * t};
}

}  // namespace

/// Neighbours in a row of the table.
template <typename T>
struct GgxAlbedo::Pair {
  BasicFactors<T> first, second;
};

GgxAlbedo::Pair<float> GgxAlbedo::two_of(int row, int first) {
  return {kTable[row][first], kTable[row][first + 1]};
}

GgxAlbedo::Pair<Lanes> GgxAlbedo::two_of(IntLanes row, IntLanes first) {
  std::array<std::array<float, 4>, kLanes> pairs;
  for (int i = 0; i < kLanes; ++i)
    std::memcpy(&pairs[static_cast<std::size_t>(i)], &kTable[row[i]][first[i]], sizeof(pairs[0]));
  const auto [m0, b0, m1, b1] = columns(std::bit_cast<std::array<Lanes, 4>>(pairs));
  return {{m0, b0}, {m1, b1}};
}

GgxAlbedo::Factors GgxAlbedo::mean_of(int row) {
  return kTable[row][kCosines];
}

GgxAlbedo::BasicFactors<Lanes> GgxAlbedo::mean_of(IntLanes row) {
  BasicFactors<Lanes> means;
  for (int i = 0; i < kLanes; ++i) {
    const Factors mean = kTable[row[i]][kCosines];
    means.missing[i] = mean.missing, means.bias[i] = mean.bias;
  }
  return means;
}

template <typename T>
GgxAlbedo::BasicFactors<T> GgxAlbedo::directional(T cos_theta, T roughness) {
  const auto [r, tr] = locate_roughness(roughness, kRoughnesses);
  const auto [c, tc] = locate_cosine(cos_theta, kCosines);
  const Pair<T> smoother = two_of(r, c), rougher = two_of(r + 1, c);
  return lerp(lerp(smoother.first, smoother.second, tc), lerp(rougher.first, rougher.second, tc), tr);
}

template <typename T>
GgxAlbedo::BasicFactors<T> GgxAlbedo::average(T roughness) {
  const auto [r, t] = locate_roughness(roughness, kRoughnesses);
  return lerp(mean_of(r), mean_of(r + 1), t);
}

template GgxAlbedo::BasicFactors<float> GgxAlbedo::directional(float, float);
template GgxAlbedo::BasicFactors<Lanes> GgxAlbedo::directional(Lanes, Lanes);
template GgxAlbedo::BasicFactors<float> GgxAlbedo::average(float);
template GgxAlbedo::BasicFactors<Lanes> GgxAlbedo::average(Lanes);

}  // namespace photopic
