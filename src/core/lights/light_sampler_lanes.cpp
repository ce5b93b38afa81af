#include "core/lights/area_light_lanes.h"
#include "core/lights/light_sampler.h"

namespace photopic {

LightSampler::Picks LightSampler::pick_lights(const LightReferenceLanes& at) const {
  Picks picks;
  std::array<double, kLanes> u{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(at.count); ++k) {
    picks[k] = pick(at.spectra[k], at.u_choice[k]);
    u[k] = picks[k].u;
  }

  // Down the trees, one after the other.
  for (const Group& group : groups_) {
    if (group.tree.empty()) continue;
    std::array<std::uint32_t, kLanes> lanes;
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < kLanes; ++k)
      if (picks[k].tree == &group.tree) lanes[count++] = k;
    if (count == 0) continue;
    const std::span<const std::uint32_t> wanted(lanes.data(), count);
    LightTree::Choices choices;
    group.tree.choose({at.position, at.normal}, u, wanted, choices);
    for (const std::uint32_t k : wanted) picks[k].take(choices[k]);
  }

  // What is chosen is soon wanted.
  for (const Pick& pick : picks)
    if (pick.light < area_lights_.list().size()) __builtin_prefetch(&area_lights_.list()[pick.light]);
  return picks;
}

void LightSampler::fill_emission(const AreaLight& light, int lane, LightSampleLanes& s) const {
  const AreaLights::Emission& emission = area_lights_.emission(light);
  s.radiance[lane] = emission.luminance, s.spectrum[lane] = emission.spectrum;
}

void LightSampler::sample(const LightReferenceLanes& at, LightSampleLanes& s) const {
  const Picks picks = pick_lights(at);

  // Area lights all at once, the others one by one.
  const std::vector<AreaLight>& list = area_lights_.list();
  IntLanes other = IntLanes{} - 1;
  if (!list.empty()) {
    std::array<const AreaLight*, kLanes> lights;
    lights.fill(&list[0]);
    for (int i = 0; i < at.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (picks[k].light < list.size()) lights[k] = &list[picks[k].light], other[i] = 0;
    }
    AreaLightLanes(lights).sample(at.position, at.u, s);
    for (int i = 0; i < at.count; ++i) fill_emission(*lights[static_cast<std::size_t>(i)], i, s);
  }
  for (int i = 0; i < at.count; ++i) {
    const Pick& chosen = picks[static_cast<std::size_t>(i)];
    if (other[i])
      s.set(i, chosen.light == kNoLight ? std::nullopt
                                        : sample_light(chosen.light, lane(at.position, i), lane(at.u, i)));
    s.pdf[i] *= chosen.probability;
  }
}

void LightSampler::sample_only_light(const Vec3Lanes& from, const Sample2dLanes& u,
                                     LightSampleLanes& s) const {
  const AreaLight& light = area_lights_.list()[*only_area_light_];
  AreaLightLanes(light).sample(from, u, s);
  for (int i = 0; i < kLanes; ++i) fill_emission(light, i, s);
}

}  // namespace photopic
