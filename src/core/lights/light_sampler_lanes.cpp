#include "core/lights/area_light_lanes.h"
#include "core/lights/light_sampler.h"

namespace photopic {

LightTree::Choices LightSampler::choose_among_all(const LightReferenceLanes& at) const {
  std::array<Pick, kLanes> picks;
  for (std::size_t k = 0; k < static_cast<std::size_t>(at.count); ++k)
    picks[k] = pick(at.spectra[k], at.u_choice[k]);
  DoubleLanes u;
  for (int i = 0; i < kLanes; ++i) u[i] = picks[static_cast<std::size_t>(i)].u;

  // Down the trees, one after the other.
  LightTree::Choices choices;
  for (const Group& group : groups_) {
    if (group.tree.empty()) continue;
    std::array<std::uint32_t, kLanes> lanes;
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < kLanes; ++k)
      if (picks[k].tree == &group.tree) lanes[count++] = k;
    if (count == 0) continue;
    const std::span<const std::uint32_t> wanted(lanes.data(), count);
    group.tree.choose({at.position, at.normal}, u, wanted, choices);
    for (const std::uint32_t k : wanted) picks[k].take(choices[k]);
  }
  for (std::size_t k = 0; k < kLanes; ++k) choices[k] = {picks[k].light, picks[k].probability};
  return choices;
}

const LightTree* LightSampler::only_tree() const {
  const Group& group = groups_[only_group_];
  return lit_groups_ == 1 && group.lights.size() == 1 && group.lights[0] == kNoLight ? &group.tree : nullptr;
}

LightTree::Choices LightSampler::choose_lights(const LightReferenceLanes& at) const {
  const LightTree* tree = only_tree();
  if (!tree) return choose_among_all(at);
  static constexpr std::array<std::uint32_t, kLanes> kAll{0, 1, 2,  3,  4,  5,  6,  7,
                                                          8, 9, 10, 11, 12, 13, 14, 15};
  LightTree::Choices choices;
  choices.fill({kNoLight, 0.0f});
  tree->choose({at.position, at.normal}, at.u_choice,
               std::span(kAll).first(static_cast<std::size_t>(at.count)), choices);
  return choices;
}

// Lanes that are filled one by one are filled in registers: a whole vector read from memory waits for the
// numbers stored there before it.

void LightSampler::fill_emission(const std::array<const AreaLight*, kLanes>& lights,
                                 LightSampleLanes& s) const {
  Lanes luminance;
  IntLanes spectrum;
  for (int i = 0; i < kLanes; ++i) {
    const AreaLights::Emission& emission = area_lights_.emission(*lights[static_cast<std::size_t>(i)]);
    luminance[i] = emission.luminance, spectrum[i] = emission.spectrum;
  }
  s.radiance = luminance, s.spectrum = spectrum;
}

void LightSampler::sample(const LightReferenceLanes& at, LightSampleLanes& s) const {
  const std::vector<AreaLight>& list = area_lights_.list();
  const LightTree::Choices choices = choose_lights(at);
  UintLanes light;
  Lanes probability;
  for (int i = 0; i < kLanes; ++i) {
    const LightTree::Choice& choice = choices[static_cast<std::size_t>(i)];
    light[i] = choice.light, probability[i] = choice.probability;
    if (choice.light < list.size()) __builtin_prefetch(&list[choice.light]);
  }

  // Area lights all at once, the others one by one.
  const IntLanes other = light >= static_cast<std::uint32_t>(list.size());
  if (!list.empty()) {
    std::array<const AreaLight*, kLanes> lights;
    for (std::size_t k = 0; k < kLanes; ++k)
      lights[k] = &list[choices[k].light < list.size() ? choices[k].light : 0];
    AreaLightLanes(lights).sample(at.position, at.u, s);
    fill_emission(lights, s);
  }
  for_each_lane(other, [&](int i) {
    const std::uint32_t choice = choices[static_cast<std::size_t>(i)].light;
    s.set(i, choice == kNoLight ? std::nullopt : sample_other(choice, lane(at.position, i), lane(at.u, i)));
  });
  s.pdf *= probability;
}

void LightSampler::sample_only_light(const Vec3Lanes& from, const Sample2dLanes& u,
                                     LightSampleLanes& s) const {
  const AreaLight& light = area_lights_.list()[*only_area_light_];
  const AreaLights::Emission& emission = area_lights_.emission(light);
  AreaLightLanes(light).sample(from, u, s);
  s.radiance = Lanes{} + emission.luminance, s.spectrum = IntLanes{} + emission.spectrum;
}

}  // namespace photopic
