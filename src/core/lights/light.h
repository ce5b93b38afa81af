#pragma once

#include <cstdint>

#include "core/math.h"

namespace photopic {

/// A point that light is gathered at, or one in each lane.
template <typename T>
struct BasicLightReference {
  Vec3<T> position;
  Vec3<T> normal;     ///< unit: light arrives from its side alone; zero: from all around
  IndexOf<T> view{};  ///< of the sky, where there are several: see LightSampler::view_at()
};
using LightReference = BasicLightReference<float>;

inline constexpr std::uint32_t kNoMaterial = ~0u;

/// Light on its way to a LightReference, chosen for next-event estimation.
struct LightSample {
  Vec3f direction;   ///< to the light, unit
  float distance;    ///< [m]; infinite for directional lights and the environment
  Vec3f end;         ///< where the shadow ray ends, when the distance is finite
  float pdf;         ///< of the direction [1/sr]; delta: the probability of having chosen the light
  float radiance;    ///< factor on the emission spectrum [cd/m²]; delta: of the irradiance facing it [lx]
  bool delta;        ///< BSDF sampling cannot find it
  int spectrum;      ///< index into Scene::emission_spectra
  bool environment;  ///< its colour in that direction is a factor on the spectrum, `radiance` being 1
  std::uint32_t material = kNoMaterial;  ///< of an area light: what varies over it is left to the caller
  std::uint32_t triangle = 0;            ///< of an area light: where the point lies
};

/// Stands where there is no light.
inline constexpr std::uint32_t kNoLight = ~0u;

}  // namespace photopic
