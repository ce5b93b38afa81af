#include "core/lights/light_sampler.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

namespace photopic {
namespace {

/// A light that is brighter than any number must be chosen, for what it does to be seen in the result.
constexpr double kMostPower = 1e200;  // [lm]

// In any unit.
constexpr double kFaintIlluminance = 1e-20, kMostIlluminance = 1e20;

/// No path finds directional lights but by their samples: of those of the sky they get this share at least.
constexpr double kLeastDirectional = 0.05;

constexpr double kPiD = std::numbers::pi;

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

LightSampler::LightSampler(const Scene& scene, double radius, std::span<const Surface> surfaces,
                           SkyViews views)
    : area_lights_(scene, surfaces),
      punctual_lights_(scene.punctual_lights),
      environment_(scene.environment),
      views_(std::move(views)),
      power_of_spectrum_(scene.emission_spectra.size()) {
  if (const Sky sky(scene); views_.empty() && !sky.empty()) views_ = SkyViews(sky, {}, {});
  uses_normals_ = views_.differ();
  const Powers powers = list_powers(radius);
  for (std::size_t i = 0; i < powers.power.size(); ++i)
    if (powers.power[i] > 0.0)
      power_of_spectrum_[static_cast<std::size_t>(powers.spectrum[i])] += powers.power[i];
  // Specks of light on a dark texture may escape all estimates: then each spectrum counts alike.
  if (std::ranges::none_of(powers.power, [](double p) { return p > 0.0; }))
    std::ranges::fill(power_of_spectrum_, 1.0);
  make_groups(powers);
  if (groups_.size() == 1 && groups_[0].lights.size() == 1 &&
      groups_[0].lights[0] < area_lights_.list().size())
    only_area_light_ = groups_[0].lights[0];
}

void LightSampler::make_groups(const Powers& powers) {
  const auto& [power, spectrum] = powers;
  std::set<int> spectra;  // of lights within the scene
  double total = 0.0;
  for (std::uint32_t i = 0; i < power.size(); ++i)
    if (power[i] > 0.0 && kind_of(i) == Kind::within) spectra.insert(spectrum[i]), total += power[i];
  places_.resize(power.size());
  for (std::uint32_t i = 0; i < power.size(); ++i)
    if (power[i] > 0.0) add_to_group(i, spectrum[i], spectra.size() > kMostSpectra);
  if (!(total > 0.0)) total = 1.0;
  for (Group& group : groups_) {
    if (group.spectrum == kMixed) weighs_spectra_ = false;
    if (group.kind == Kind::within) plant_tree(group, power, total);
    if (group.kind != Kind::directional) continue;
    std::vector<double> weights;
    for (const std::uint32_t light : group.lights) weights.push_back(power[light]);
    group.by_illuminance = AliasTable(weights);
  }
  weigh_sky(total);
}

/// @param one_tree whether lights of all spectra stand in one
void LightSampler::add_to_group(std::uint32_t light, int spectrum, bool one_tree) {
  const Kind kind = kind_of(light);
  auto group = std::ranges::find_if(groups_, [&](const Group& g) {
    return g.kind == kind && (g.spectrum == spectrum || kind != Kind::within || one_tree);
  });
  if (group == groups_.end()) group = groups_.insert(group, {.kind = kind, .spectrum = spectrum});
  if (group->spectrum != spectrum) group->spectrum = kMixed;
  places_[light] = {static_cast<std::uint32_t>(group - groups_.begin()),
                    static_cast<std::uint32_t>(group->lights.size())};
  group->lights.push_back(light);
}

/// @param total power of all groups' lights within the scene [lm]
void LightSampler::weigh_sky(double total) {
  const bool has_directional =
      std::ranges::any_of(groups_, [](const Group& g) { return g.kind == Kind::directional; });
  for (const SkyViews::Light& light : views_.lights()) {
    const double all = std::max(light.environment + light.directional, kFaintIlluminance);
    const double directional =
        has_directional ? std::clamp(light.directional, kLeastDirectional * all, all) : 0.0;
    const auto share = [&](double illuminance) {
      return static_cast<float>(std::clamp(illuminance / total, kFaintIlluminance, kMostIlluminance));
    };
    // Paths find the environment by themselves.
    sky_.push_back({light.environment > 0.0 ? share(light.environment) : 0.0f,
                    has_directional ? share(directional) : 0.0f, light.any ? kLeastShare : kLeastUnseen});
  }
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

LightSampler::Kind LightSampler::kind_of(std::uint32_t light) const {
  const std::size_t areas = area_lights_.list().size();
  if (light == environment_index()) return Kind::environment;
  return light >= areas && punctual_lights_[light - areas].kind == PunctualLight::Kind::directional
             ? Kind::directional
             : Kind::within;
}

LightBounds LightSampler::bounds_of(std::uint32_t light) const {
  const std::size_t areas = area_lights_.list().size();
  return light < areas ? photopic::bounds_of(area_lights_.list()[light])
                       : photopic::bounds_of(punctual_lights_[light - areas]);
}

/// @param total power of all groups' lights within the scene [lm]
void LightSampler::plant_tree(Group& group, std::span<const double> power, double total) {
  if (group.lights.size() > 1) uses_normals_ = true;
  std::vector<LightBounds> bounds;
  for (const std::uint32_t light : group.lights) {
    bounds.push_back(bounds_of(light));
    float& intensity = bounds.back().intensity;
    intensity =
        std::max(intensity * static_cast<float>(power[light] / total), std::numeric_limits<float>::min());
    group.intensity += intensity;
  }
  group.tree = LightTree(bounds, group.lights);
}

void LightSampler::group_probabilities(std::span<float> brightness, const GroupShares& shares,
                                       int lane) const {
  float total = 0.0f;
  for (std::size_t k = 0; k < brightness.size(); ++k)
    total += brightness[k] *= photopic::lane(shares[k], lane);
  if (total == 0.0f) return;
  const bool is_number =
      total < std::numeric_limits<float>::infinity();  // else it shall be seen in the result
  for (std::size_t k = 0; k < brightness.size(); ++k)
    brightness[k] = is_number ? brightness[k] / total : photopic::lane(shares[k], lane);
}

float LightSampler::choice_probability(const LightReference& at, std::span<const float> groups,
                                       std::uint32_t light) const {
  const auto [k, leaf] = places_[light];
  if (k == kNoGroup) return 0.0f;
  const Group& group = groups_[k];
  const float probability = groups.empty() ? 1.0f : groups[k];
  return group.has_tree() ? probability * group.tree.probability(at, leaf) : probability;
}

float LightSampler::environment_pdf(const LightReference& at, std::span<const float> groups,
                                    Vec3f direction) const {
  const float probability = choice_probability(at, groups, environment_index());
  return probability > 0.0f ? probability * views_.pdf(*environment_, at.view, direction) : 0.0f;
}

float LightSampler::pdf(const LightReference& at, std::span<const float> groups, std::uint32_t shape,
                        std::uint32_t triangle, float distance) const {
  const std::uint32_t i = area_lights_.light_of(shape, triangle);
  if (i == kNoLight) return 0.0f;
  const float probability = choice_probability(at, groups, i);
  return probability > 0.0f ? probability * area_lights_.list()[i].pdf(at.position, distance) : 0.0f;
}

}  // namespace photopic
