#include "core/lights/light_sampler.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

namespace photopic {
namespace {

/// Power says little about how lights within the scene compare with those beyond it: of what use is the sky
/// in a closed room, or a lamp in a landscape? Neither kind gets less than this share of the choices.
constexpr double kLeastShare = 0.25;

/// A light that is brighter than any number must be chosen, for what it does to be seen in the result.
constexpr double kMostPower = 1e200;  // [lm]

constexpr double kPiD = std::numbers::pi;

/// The factor on unbounded lights that keeps both shares.
double balance(double bounded, double unbounded) {
  if (!(bounded > 0.0) || !(unbounded > 0.0)) return 1.0;
  const double share = std::clamp(unbounded / (bounded + unbounded), kLeastShare, 1.0 - kLeastShare);
  return share / (1.0 - share) * bounded / unbounded;
}

/// Of a light with a flux of 1.
LightBounds bounds_of(const AreaLight& light) {
  const Vec3f a = light.vertex, b = a + light.edge1, c = a + light.edge2;
  const Vec3f d = light.parallelogram ? b + light.edge2 : a;
  const auto low = [&](auto of) { return std::min({of(a), of(b), of(c), of(d)}); };
  const auto high = [&](auto of) { return std::max({of(a), of(b), of(c), of(d)}); };
  const auto x = [](Vec3f v) { return v.x; };
  const auto y = [](Vec3f v) { return v.y; };
  const auto z = [](Vec3f v) { return v.z; };
  return {.low = {low(x), low(y), low(z)},
          .high = {high(x), high(y), high(z)},
          .axis = light.normal,
          .cos_o = 1.0f,
          .cos_e = 0.0f,
          .intensity = 1.0f / (kPi * std::sqrt(light.double_sided ? 12.0f : 6.0f)),
          .two_sided = light.double_sided};
}

/// A cone that shines no further than it is wide still holds what rounding leaves of it.
constexpr float kWidestCosine = 1.0f - 1e-6f;

LightBounds bounds_of(const PunctualLight& light) {
  const bool spot = light.kind == PunctualLight::Kind::spot;
  const float rim = spot ? std::max(std::acos(light.cos_outer) - std::acos(light.cos_inner), 0.0f) : 0.0f;
  return {.low = light.position,
          .high = light.position,
          .axis = light.direction,
          .cos_o = spot ? light.cos_inner : -1.0f,
          .cos_e = spot ? std::min(std::cos(rim), kWidestCosine) : -1.0f,
          .intensity = static_cast<float>(light.rms_intensity() / light.power(0.0))};
}

}  // namespace

LightSampler::LightSampler(const Scene& scene, double radius, std::span<const Surface> surfaces)
    : area_lights_(scene, surfaces),
      punctual_lights_(scene.punctual_lights),
      environment_(scene.environment),
      power_of_spectrum_(scene.emission_spectra.size()) {
  const auto [power, spectrum] = list_powers(radius);
  places_.resize(power.size());
  std::set<int> kinds;
  double bounded = 0.0, unbounded = 0.0;
  int bounded_count = 0;
  for (std::uint32_t i = 0; i < power.size(); ++i) {
    if (!(power[i] > 0.0)) continue;
    kinds.insert(spectrum[i]);
    power_of_spectrum_[static_cast<std::size_t>(spectrum[i])] += power[i];
    if (is_unbounded(i))
      unbounded += power[i];
    else
      bounded += power[i], ++bounded_count;
  }
  groups_.resize(kinds.size() > kMostGroups ? 1 : power_of_spectrum_.size());
  std::vector<std::vector<std::uint32_t>> members(groups_.size());
  for (std::uint32_t i = 0; i < power.size(); ++i)
    if (power[i] > 0.0) members[group_of(spectrum[i])].push_back(i);

  // Specks of light on a dark texture may escape all estimates: then each spectrum counts alike.
  if (!(bounded + unbounded > 0.0)) std::ranges::fill(power_of_spectrum_, 1.0);

  // What they are chosen by.
  const double factor = balance(bounded, unbounded), total = bounded + factor * unbounded;
  std::vector<double> weight = power;
  for (std::uint32_t i = 0; i < power.size(); ++i) weight[i] *= (is_unbounded(i) ? factor : 1.0) / total;
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    if (members[k].empty()) continue;
    lit_groups_.push_back(k);
    make_group(groups_[k], members[k], weight, bounded_count > 1);
  }
  only_area_light_ = find_only_area_light();
}

LightSampler::Powers LightSampler::list_powers(double radius) const {
  Powers powers;
  const auto add = [&](double power, int spectrum) {
    powers.power.push_back(std::min(power, kMostPower)), powers.spectrum.push_back(spectrum);
  };
  for (std::uint32_t i = 0; i < area_lights_.list().size(); ++i)
    add(area_lights_.power(i), area_lights_.emission(area_lights_.list()[i]).spectrum);
  for (const PunctualLight& light : punctual_lights_) add(light.power(radius), light.emission_spectrum);
  if (environment_)
    add(environment_->flux_density() * kPiD * radius * radius, environment_->emission_spectrum);
  return powers;
}

std::optional<std::uint32_t> LightSampler::find_only_area_light() const {
  if (lit_groups_.size() != 1) return {};
  const auto& lights = groups_[lit_groups_.front()].lights;
  if (lights.size() != 1 || lights[0] >= area_lights_.list().size()) return {};
  return lights[0];
}

bool LightSampler::is_unbounded(std::uint32_t light) const {
  const std::size_t areas = area_lights_.list().size();
  return light == environment_index() ||
         (light >= areas && punctual_lights_[light - areas].kind == PunctualLight::Kind::directional);
}

LightBounds LightSampler::bounds_of(std::uint32_t light) const {
  const std::size_t areas = area_lights_.list().size();
  return light < areas ? photopic::bounds_of(area_lights_.list()[light])
                       : photopic::bounds_of(punctual_lights_[light - areas]);
}

void LightSampler::make_group(Group& group, std::span<const std::uint32_t> members,
                              std::span<const double> weight, bool in_trees) {
  const bool has_bounded = !std::ranges::all_of(members, [this](std::uint32_t i) { return is_unbounded(i); });
  std::vector<double> entries;
  const auto add_entry = [&](std::uint32_t light, double w) {
    group.lights.push_back(light);
    entries.push_back(w);
    return static_cast<std::uint32_t>(entries.size() - 1);
  };
  if (in_trees && has_bounded) {
    uses_normals_ = true;
    const std::uint32_t entry = add_entry(kNoLight, 0.0);
    std::vector<LightBounds> bounds;
    std::vector<std::uint32_t> names;
    for (const std::uint32_t i : members) {
      if (is_unbounded(i)) continue;
      places_[i] = {entry, static_cast<std::uint32_t>(bounds.size())};
      names.push_back(i);
      bounds.push_back(bounds_of(i));
      bounds.back().intensity *= static_cast<float>(weight[i]);
      entries[entry] += weight[i];
      group.intensity += bounds.back().intensity;
    }
    group.tree = LightTree(bounds, names);
    if (names.size() == 1) group.lights[entry] = names[0];
  }
  for (const std::uint32_t i : members)
    if (group.tree.empty() || is_unbounded(i)) places_[i] = {add_entry(i, weight[i]), 0};
  for (const std::uint32_t i : members)
    (is_unbounded(i) ? group.unbounded : group.bounded) += static_cast<float>(weight[i]);
  group.table = AliasTable(entries);
}

void LightSampler::spectrum_probabilities(std::span<float> brightness, const GroupShares& shares,
                                          int lane) const {
  std::array<float, kMostGroups> weight;
  float total = 0.0f;
  for (std::size_t j = 0; j < lit_groups_.size(); ++j)
    total += weight[j] = brightness[lit_groups_[j]] * photopic::lane(shares[j], lane);
  std::ranges::fill(brightness, 0.0f);
  if (total == 0.0f) return;
  const bool is_number =
      total < std::numeric_limits<float>::infinity();  // else it shall be seen in the result
  for (std::size_t j = 0; j < lit_groups_.size(); ++j)
    brightness[lit_groups_[j]] = is_number ? weight[j] / total : photopic::lane(shares[j], lane);
}

std::optional<LightSample> LightSampler::sample_other(std::uint32_t light, Vec3f from, Sample2d u) const {
  if (light < environment_index()) return punctual_lights_[light - area_lights_.list().size()].sample(from);
  const Environment::Sample way = environment_->sample(u);
  if (!(way.pdf > 0.0f)) return {};
  LightSample s{};
  s.direction = way.direction;
  s.distance = std::numeric_limits<float>::infinity();
  s.pdf = way.pdf;
  s.radiance = 1.0f;
  s.spectrum = environment_->emission_spectrum;
  s.environment = true;
  return s;
}

float LightSampler::choice_probability(const LightReference& at, std::span<const float> spectra, int spectrum,
                                       std::uint32_t light) const {
  const PlaceInGroup& place = places_[light];
  if (place.entry == kNoLight) return 0.0f;
  const std::size_t k = group_of(spectrum);
  const Group& group = groups_[k];
  float probability = group.table.probability(place.entry);
  if (!spectra.empty()) probability *= spectra[k];
  if (group.lights[place.entry] == kNoLight) probability *= group.tree.probability(at, place.leaf);
  return probability;
}

float LightSampler::environment_pdf(const LightReference& at, std::span<const float> spectra,
                                    Vec3f direction) const {
  const float probability =
      choice_probability(at, spectra, environment_->emission_spectrum, environment_index());
  return probability > 0.0f ? probability * environment_->pdf(direction) : 0.0f;
}

float LightSampler::pdf(const LightReference& at, std::span<const float> spectra, std::uint32_t shape,
                        std::uint32_t triangle, float distance) const {
  const std::uint32_t i = area_lights_.light_of(shape, triangle);
  if (i == kNoLight) return 0.0f;
  const AreaLight& light = area_lights_.list()[i];
  const float probability = choice_probability(at, spectra, area_lights_.emission(light).spectrum, i);
  return probability > 0.0f ? probability * light.pdf(at.position, distance) : 0.0f;
}

}  // namespace photopic
