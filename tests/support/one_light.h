#pragma once

#include <numeric>
#include <optional>
#include <vector>

#include "core/lights/area_light_lanes.h"
#include "core/lights/light_sampler.h"

namespace photopic::test {

/// @param radius of the scene [m]
inline LightSampler lights_of(const Scene& scene, double radius = 1.0) {
  return {scene, radius, std::vector<Surface>(scene.materials.begin(), scene.materials.end())};
}
inline AreaLights area_lights_of(const Scene& scene) {
  return {scene, std::vector<Surface>(scene.materials.begin(), scene.materials.end())};
}
/// A tree that calls lights by their indices.
inline LightTree tree_of(const std::vector<LightBounds>& lights) {
  std::vector<std::uint32_t> names(lights.size());
  std::iota(names.begin(), names.end(), 0u);
  return {lights, names};
}

/// A lane of many, or nothing where the light does not reach.
inline std::optional<LightSample> lane_of(const LightSampleLanes& s, int i) {
  if (s.reached[i] == 0) return {};
  return LightSample{.direction = lane(s.direction, i),
                     .distance = s.distance[i],
                     .end = lane(s.end, i),
                     .pdf = s.pdf[i],
                     .radiance = s.radiance[i],
                     .delta = s.delta[i] != 0,
                     .spectrum = s.spectrum[i],
                     .environment = s.environment[i] != 0,
                     .material = s.material[i],
                     .triangle = s.triangle[i]};
}

// One at a time what the code under test does for many.

inline std::optional<LightSample> sample_one(const LightSampler& lights, const LightReference& at,
                                             std::span<const float> groups, double u_choice, Sample2d u) {
  LightSampleLanes samples;
  lights.sample({.place = {broadcast<Lanes>(at.position), broadcast<Lanes>(at.normal), IntLanes{} + at.view},
                 .groups = {groups},
                 .u_choice = DoubleLanes{} + u_choice,
                 .u = {Lanes{} + u.x, Lanes{} + u.y},
                 .count = 1},
                samples);
  return lane_of(samples, 0);
}

/// @param brightness of each group's spectrum
inline std::vector<float> group_probabilities(const LightSampler& lights, const LightReference& at,
                                              std::vector<float> brightness) {
  const auto shares =
      lights.group_shares({broadcast<Lanes>(at.position), broadcast<Lanes>(at.normal), IntLanes{} + at.view});
  lights.group_probabilities(brightness, shares, 0);
  return brightness;
}

inline std::optional<LightSample> sample_one(const AreaLight& light, Vec3f from, Sample2d u) {
  LightSampleLanes samples;
  AreaLightLanes(light).sample(broadcast<Lanes>(from), {Lanes{} + u.x, Lanes{} + u.y}, samples);
  return lane_of(samples, 0);
}

inline LightTree::Choice choose_one(const LightTree& tree, const LightReference& at, double u) {
  LightTree::Choices choices;
  tree.choose({broadcast<Lanes>(at.position), broadcast<Lanes>(at.normal)}, DoubleLanes{} + u, std::array{0u},
              choices);
  return choices[0];
}

}  // namespace photopic::test
