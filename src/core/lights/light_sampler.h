#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/lights/alias_table.h"
#include "core/lights/area_light.h"
#include "core/lights/light_sample_lanes.h"
#include "core/lights/light_tree.h"
#include "core/lights/sky_views.h"

namespace photopic {

/// Chooses lights for next-event estimation: first one of a few groups of them, by what its lights may add to
/// the path's wavelengths where it is; then a light of the group, then a direction to that light. Lights
/// within the scene are chosen by a tree, a group for each of their emission spectra if these are few; what
/// lies beyond the scene by what is seen of it: directional lights are a group, and the environment one.
class LightSampler {
 public:
  /// Of more kinds of light a tree for each costs more than to know the kind saves: one holds all.
  static constexpr std::size_t kMostSpectra = 4;
  static constexpr std::size_t kMostGroups = kMostSpectra + 2;

  /// @param radius of a sphere about the scene: what directional lights and the environment light [m]
  /// @param surfaces of the scene's materials @param views of its sky, or none: all of it is seen from
  /// everywhere
  LightSampler(const Scene& scene, double radius, std::span<const Surface> surfaces, SkyViews views = {});

  bool empty() const { return groups_.empty(); }

  /// Whether a group is chosen first, so that the functions below want the probabilities of each. Else they
  /// are given an empty list.
  bool several_groups() const { return groups_.size() > 1; }
  std::size_t group_count() const { return groups_.size(); }

  /// The emission spectrum that a group's lights have; −1 where brightness is to be 1 for all groups, since
  /// in some lights differ.
  int spectrum_of(std::size_t group) const { return weighs_spectra_ ? groups_[group].spectrum : -1; }

  /// Whether the choice depends on the normal of the LightReference, or on its view of the sky.
  bool uses_normals() const { return uses_normals_; }

  /// Whether the sky is seen differently from different places.
  bool views_differ() const { return views_.differ(); }
  IntLanes view_at(const BasicLightReference<Lanes>& at) const { return views_.view_at(at); }

  /// Shares of the choices that groups of lights get at 16 places whatever the paths' wavelengths.
  using GroupShares = std::array<Lanes, kMostGroups>;
  GroupShares group_shares(const BasicLightReference<Lanes>& at) const;

  /// Turns the brightness of each group's spectrum on its way to a path's result (its values at the path's
  /// wavelengths times throughput and observer, up to a common factor) into the probability of choosing it.
  /// @param lane of the path among those whose shares are given
  void group_probabilities(std::span<float> brightness, const GroupShares& shares, int lane) const;

  /// A light for each point, and a direction to it.
  void sample(const LightReferenceLanes& at, LightSampleLanes& samples) const;

  /// Whether one area light is all there is.
  bool has_only_light() const { return only_area_light_.has_value(); }
  /// The same of it: it wants neither normals nor a choice.
  void sample_only_light(const Vec3Lanes& from, const Sample2dLanes& u, LightSampleLanes& samples) const;

  /// The density with which sample() gives a direction that ends at a glowing triangle [1/sr].
  /// @param groups as LightReferenceLanes has them @param distance to the hit [m]
  float pdf(const LightReference& at, std::span<const float> groups, std::uint32_t shape,
            std::uint32_t triangle, float distance) const;

  /// The density with which sample() gives a direction that leaves the scene, for the environment [1/sr].
  float environment_pdf(const LightReference& at, std::span<const float> groups, Vec3f direction) const;

  /// Luminous flux of all lights with each emission spectrum [lm].
  const std::vector<double>& power_of_spectrum() const { return power_of_spectrum_; }

 private:
  static constexpr int kMixed = -1;

  enum class Kind { within, directional, environment };
  struct Group {
    Kind kind;
    int spectrum;                         ///< or kMixed
    std::vector<std::uint32_t> lights{};  ///< of the group
    LightTree tree{};                     ///< of those within the scene
    float intensity = 0.0f;               ///< of the tree's lights, in one unit for all groups
    AliasTable by_illuminance{};          ///< of directional lights
    bool has_tree() const { return kind == Kind::within && lights.size() > 1; }
  };
  /// Where a light stands.
  struct PlaceInGroup {
    std::uint32_t group = kNoGroup, leaf = 0;
  };
  static constexpr std::uint32_t kNoGroup = ~0u;  ///< it seems dark and is never chosen

  /// What arrives from within the scene is told as if nothing were in its way, what the sky sends by a few
  /// places: neither gets less than the first share of the choices, but the sky the second where nothing of
  /// it was seen.
  static constexpr float kLeastShare = 0.1f, kLeastUnseen = 0.01f;

  /// What arrives from beyond the scene, in the unit that the groups' intensities have over square metres.
  struct SkyShare {
    float environment, directional;
    float least;  ///< share of the choices
  };

  /// Of each light.
  struct Powers {
    std::vector<double> power;  ///< luminous flux [lm]
    std::vector<int> spectrum;  ///< index into Scene::emission_spectra
  };

  /// A light, or a tree that is still to choose it.
  struct Pick {
    std::uint32_t light = kNoLight;
    float probability = 0.0f;
    const LightTree* tree = nullptr;
    double u = 0.0;  ///< for the tree

    void take(const LightTree::Choice& choice) { light = choice.light, probability *= choice.probability; }
  };
  Powers list_powers(double radius) const;
  void make_groups(const Powers& powers);
  void add_to_group(std::uint32_t light, int spectrum, bool one_tree);
  void plant_tree(Group& group, std::span<const double> power, double total);
  void weigh_sky(double total);
  Pick pick(std::span<const float> groups, double u_choice) const;
  LightTree::Choices choose_lights(const LightReferenceLanes& at) const;
  LightTree::Choices choose_among_all(const LightReferenceLanes& at) const;
  void fill_emission(const std::array<const AreaLight*, kLanes>& lights, LightSampleLanes& samples) const;
  void sample_environment(const LightReferenceLanes& at, IntLanes wanted, LightSampleLanes& samples) const;
  LightBounds bounds_of(std::uint32_t light) const;
  Kind kind_of(std::uint32_t light) const;
  /// Lights are numbered through: area lights, punctual lights, the environment.
  std::uint32_t environment_index() const {
    return static_cast<std::uint32_t>(area_lights_.list().size() + punctual_lights_.size());
  }
  float choice_probability(const LightReference& at, std::span<const float> groups,
                           std::uint32_t light) const;

  AreaLights area_lights_;
  std::vector<PunctualLight> punctual_lights_;
  std::shared_ptr<const Environment> environment_;
  SkyViews views_;
  std::vector<Group> groups_;         ///< that have lights
  std::vector<PlaceInGroup> places_;  ///< of each light
  std::vector<double> power_of_spectrum_;
  std::vector<SkyShare> sky_;  ///< of each view
  bool weighs_spectra_ = true, uses_normals_ = false;
  std::optional<std::uint32_t> only_area_light_;  ///< where there is no other light
};

inline LightSampler::Pick LightSampler::pick(std::span<const float> groups, double u_choice) const {
  // The group.
  std::size_t k = 0;
  float probability = 1.0f;
  if (!groups.empty()) {
    for (; k < groups.size() && u_choice >= groups[k]; ++k) u_choice -= groups[k];
    if (k == groups.size()) return {};
    probability = groups[k];
    u_choice = std::min(u_choice / probability, 1.0 - 0x1p-53);
  }

  // The light.
  const Group& group = groups_[k];
  if (group.has_tree()) return {kNoLight, probability, &group.tree, u_choice};
  if (group.lights.size() == 1) return {group.lights[0], probability, nullptr, u_choice};
  const std::uint32_t entry = group.by_illuminance.sample(u_choice);
  return {group.lights[entry], probability * group.by_illuminance.probability(entry), nullptr, u_choice};
}

}  // namespace photopic
