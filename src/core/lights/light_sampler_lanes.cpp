#include <limits>

#include "core/lights/area_light_lanes.h"
#include "core/lights/light_sampler.h"

namespace photopic {

LightSampler::GroupShares LightSampler::group_shares(const BasicLightReference<Lanes>& at) const {
  GroupShares shares{};
  Lanes within{};
  for (std::size_t k = 0; k < groups_.size(); ++k)
    if (groups_[k].kind == Kind::within)
      within += shares[k] = groups_[k].intensity * groups_[k].tree.total_importance(at);

  // Of the sky.
  Lanes environment{}, directional{}, least{};
  if (!sky_.empty())
    for (int i = 0; i < kLanes; ++i) {
      const SkyShare& sky = sky_[static_cast<std::size_t>(lane(at.view, i))];
      environment[i] = sky.environment, directional[i] = sky.directional, least[i] = sky.least;
    }
  const Lanes beyond = environment + directional, none{}, all = none + 1.0f;
  const Lanes both = min(max(beyond / (beyond + within), least), all - kLeastShare);
  const Lanes of_sky = select(within > 0.0f, select(beyond > 0.0f, both, none), all);
  const Lanes each_sky = select(beyond > 0.0f, of_sky / beyond, none),
              each_within = select(within > 0.0f, (1.0f - of_sky) / within, none);
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    if (groups_[k].kind == Kind::environment)
      shares[k] = each_sky * environment;
    else if (groups_[k].kind == Kind::directional)
      shares[k] = each_sky * directional;
    else
      shares[k] *= each_within;
  }
  return shares;
}

LightTree::Choices LightSampler::choose_among_all(const LightReferenceLanes& at) const {
  std::array<Pick, kLanes> picks;
  for (std::size_t k = 0; k < static_cast<std::size_t>(at.count); ++k)
    picks[k] = pick(at.groups[k], at.u_choice[k]);
  DoubleLanes u;
  for (int i = 0; i < kLanes; ++i) u[i] = picks[static_cast<std::size_t>(i)].u;

  // Down the trees, one after the other.
  LightTree::Choices choices;
  for (const Group& group : groups_) {
    if (!group.has_tree()) continue;
    std::array<std::uint32_t, kLanes> lanes;
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < kLanes; ++k)
      if (picks[k].tree == &group.tree) lanes[count++] = k;
    if (count == 0) continue;
    const std::span<const std::uint32_t> wanted(lanes.data(), count);
    group.tree.choose(at.place, u, wanted, choices);
    for (const std::uint32_t k : wanted) picks[k].take(choices[k]);
  }
  for (std::size_t k = 0; k < kLanes; ++k) choices[k] = {picks[k].light, picks[k].probability};
  return choices;
}

LightTree::Choices LightSampler::choose_lights(const LightReferenceLanes& at) const {
  if (several_groups() || !groups_.front().has_tree()) return choose_among_all(at);
  static constexpr std::array<std::uint32_t, kLanes> kAll{0, 1, 2,  3,  4,  5,  6,  7,
                                                          8, 9, 10, 11, 12, 13, 14, 15};
  LightTree::Choices choices;
  choices.fill({kNoLight, 0.0f});
  groups_.front().tree.choose(at.place, at.u_choice,
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

  // Area lights and the environment all at once, the others one by one.
  const std::uint32_t areas = static_cast<std::uint32_t>(list.size());
  if (!list.empty()) {
    std::array<const AreaLight*, kLanes> lights;
    for (std::size_t k = 0; k < kLanes; ++k)
      lights[k] = &list[choices[k].light < list.size() ? choices[k].light : 0];
    AreaLightLanes(lights).sample(at.place.position, at.u, s);
    fill_emission(lights, s);
  }
  const IntLanes environment = light == environment_index();
  if (environment_ && any(environment)) sample_environment(at, environment, s);
  for_each_lane((light >= areas) & ~environment, [&](int i) {
    const std::uint32_t choice = choices[static_cast<std::size_t>(i)].light;
    s.set(i, choice == kNoLight ? std::nullopt
                                : punctual_lights_[choice - areas].sample(lane(at.place.position, i)));
  });
  s.pdf *= probability;
}

void LightSampler::sample_environment(const LightReferenceLanes& at, IntLanes wanted,
                                      LightSampleLanes& s) const {
  const auto way = views_.sample<Lanes>(*environment_, at.place.view, at.u);
  s.direction = select(wanted, way.direction, s.direction);
  s.pdf = select(wanted, way.pdf, s.pdf);
  s.distance = select(wanted, Lanes{} + std::numeric_limits<float>::infinity(), s.distance);
  s.radiance = select(wanted, Lanes{} + 1.0f, s.radiance);
  s.reached = select(wanted, way.pdf > 0.0f, s.reached);
  s.spectrum = select(wanted, IntLanes{} + environment_->emission_spectrum, s.spectrum);
  s.delta &= ~wanted, s.environment |= wanted;
  s.material |= reinterpret_cast<UintLanes>(wanted);  // kNoMaterial
}

void LightSampler::sample_only_light(const Vec3Lanes& from, const Sample2dLanes& u,
                                     LightSampleLanes& s) const {
  const AreaLight& light = area_lights_.list()[*only_area_light_];
  const AreaLights::Emission& emission = area_lights_.emission(light);
  AreaLightLanes(light).sample(from, u, s);
  s.radiance = Lanes{} + emission.luminance, s.spectrum = IntLanes{} + emission.spectrum;
}

}  // namespace photopic
