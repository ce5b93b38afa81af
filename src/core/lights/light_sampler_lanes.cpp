#include "core/lights/area_light_lanes.h"
#include "core/lights/light_sampler.h"

namespace photopic {

LightSampler::Picks LightSampler::pick_lights(const LightReferenceLanes& at) const {
  Picks picks;
  std::array<LightTree::Descent, kLanes> descents;
  std::array<std::size_t, kLanes> under_way;
  std::size_t count = 0;
  for (int i = 0; i < at.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    picks[k] = pick(at.spectra[k], at.u_choice[k]);
    if (!picks[k].tree) continue;
    descents[k] = LightTree::Descent(*picks[k].tree, at[i], picks[k].u);
    under_way[count++] = k;
  }

  // Down the trees in turns. What is chosen is soon wanted.
  while (count > 0) {
    std::size_t still = 0;
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t k = under_way[j];
      if (descents[k].step()) {
        under_way[still++] = k;
        continue;
      }
      picks[k].take(descents[k].choice());
      if (picks[k].light < area_lights_.list().size())
        __builtin_prefetch(&area_lights_.list()[picks[k].light]);
    }
    count = still;
  }
  return picks;
}

void LightSampler::fill_emission(const AreaLight& light, int lane, LightSampleLanes& s) const {
  const AreaLights::Emission& emission = area_lights_.emission(light);
  s.radiance[lane] = emission.luminance, s.spectrum[lane] = emission.spectrum;
}

void LightSampler::sample(const LightReferenceLanes& at, LightSampleLanes& s) const {
  const Picks picks = pick_lights(at);

  // Area lights all at once, the others and those that loom large one by one.
  const std::vector<AreaLight>& list = area_lights_.list();
  IntLanes alone = IntLanes{} - 1;
  if (!list.empty()) {
    std::array<const AreaLight*, kLanes> lights;
    lights.fill(&list[0]);
    IntLanes other{};
    for (int i = 0; i < at.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (picks[k].light < list.size())
        lights[k] = &list[picks[k].light];
      else
        other[i] = -1;
    }
    alone = AreaLightLanes(lights).sample(at.position, at.u, s) | other;
    for (int i = 0; i < at.count; ++i) fill_emission(*lights[static_cast<std::size_t>(i)], i, s);
  }
  for (int i = 0; i < at.count; ++i) {
    const Pick& chosen = picks[static_cast<std::size_t>(i)];
    if (alone[i])
      s.set(i, chosen.light == kNoLight ? std::nullopt
                                        : sample_light(chosen.light, lane(at.position, i), lane(at.u, i)));
    s.pdf[i] *= chosen.probability;
  }
}

void LightSampler::sample_only_light(const Vec3Lanes& from, const Sample2dLanes& u,
                                     LightSampleLanes& s) const {
  const AreaLight& light = area_lights_.list()[*only_area_light_];
  const IntLanes alone = AreaLightLanes(light).sample(from, u, s);
  for (int i = 0; i < kLanes; ++i) fill_emission(light, i, s);
  for (int i = 0; i < kLanes; ++i)
    if (alone[i]) s.set(i, sample_light(*only_area_light_, lane(from, i), lane(u, i)));
}

}  // namespace photopic
