#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/lights/alias_table.h"
#include "core/lights/area_light.h"
#include "core/lights/light_sample_lanes.h"
#include "core/lights/light_tree.h"

namespace photopic {

/// Chooses lights for next-event estimation: where lamps are of a few kinds, first an emission spectrum, by
/// what its lights may add to the path's wavelengths where it is; then a light that has it, by the light
/// tree, those beyond the scene by power; then a direction to that light.
class LightSampler {
 public:
  /// Of more kinds of light a tree for each costs more than to know the kind saves: one holds all.
  static constexpr std::size_t kMostGroups = 4;

  /// @param radius of a sphere about the scene: what directional lights and the environment light [m]
  /// @param surfaces of the scene's materials
  LightSampler(const Scene& scene, double radius, std::span<const Surface> surfaces);

  bool empty() const { return lit_groups_.empty(); }

  /// Whether a spectrum is chosen first, so that the functions below want the probabilities of each. Else
  /// they are given an empty list.
  bool several_spectra() const { return lit_groups_.size() > 1; }

  /// Whether the choice depends on the normal of the LightReference.
  bool uses_normals() const { return uses_normals_; }

  /// Shares of the choices that groups of lights get at 16 places whatever the paths' wavelengths.
  using GroupShares = std::array<Lanes, kMostGroups>;
  GroupShares group_shares(const BasicLightReference<Lanes>& at) const;

  /// Turns the brightness of each emission spectrum on its way to a path's result (its values at the path's
  /// wavelengths times throughput and observer, up to a common factor) into the probability of choosing it.
  /// @param lane of the path among those whose shares are given
  void spectrum_probabilities(std::span<float> brightness, const GroupShares& shares, int lane) const;

  /// A light for each point, and a direction to it.
  void sample(const LightReferenceLanes& at, LightSampleLanes& samples) const;

  /// Whether one area light is all there is.
  bool has_only_light() const { return only_area_light_.has_value(); }
  /// The same of it: it wants neither normals nor a choice.
  void sample_only_light(const Vec3Lanes& from, const Sample2dLanes& u, LightSampleLanes& samples) const;

  /// The density with which sample() gives a direction that ends at a glowing triangle [1/sr].
  /// @param spectra as LightReferenceLanes has them @param distance to the hit [m]
  float pdf(const LightReference& at, std::span<const float> spectra, std::uint32_t shape,
            std::uint32_t triangle, float distance) const;

  /// The density with which sample() gives a direction that leaves the scene, for the environment [1/sr].
  float environment_pdf(const LightReference& at, std::span<const float> spectra, Vec3f direction) const;

  /// Luminous flux of all lights with each emission spectrum [lm].
  const std::vector<double>& power_of_spectrum() const { return power_of_spectrum_; }

 private:
  /// The lights of one spectrum, or all: choices between single lights, one of which may stand for a tree of
  /// them.
  struct Group {
    AliasTable table;
    std::vector<std::uint32_t> lights;       ///< of each entry of the table; kNoLight: the tree
    LightTree tree;                          ///< of one light, too, which is an entry of its own
    float intensity = 0.0f;                  ///< of the tree's lights, in one unit for all groups
    float bounded = 0.0f, unbounded = 0.0f;  ///< shares of the choices, by power
  };
  /// Where a light stands in its group.
  struct PlaceInGroup {
    std::uint32_t entry = kNoLight;  ///< of the table; kNoLight: it seems dark and is never chosen
    std::uint32_t leaf = 0;          ///< of the tree, when that is the entry
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
  std::optional<std::uint32_t> find_only_area_light() const;
  Pick pick(std::span<const float> spectra, double u_choice) const;
  LightTree::Choices choose_lights(const LightReferenceLanes& at) const;
  LightTree::Choices choose_among_all(const LightReferenceLanes& at) const;
  /// The tree beside which there is no light, or null.
  const LightTree* only_tree() const;
  void fill_emission(const std::array<const AreaLight*, kLanes>& lights, LightSampleLanes& samples) const;
  /// @param weight of each light: its share of the choices @param in_trees whether lights that are bounded
  /// stand in one
  void make_group(Group& group, std::span<const std::uint32_t> members, std::span<const double> weight,
                  bool in_trees);
  LightBounds bounds_of(std::uint32_t light) const;
  bool is_unbounded(std::uint32_t light) const;
  std::size_t group_of(int spectrum) const {
    return groups_.size() == 1 ? 0 : static_cast<std::size_t>(spectrum);
  }
  /// @param light no area light
  std::optional<LightSample> sample_other(std::uint32_t light, Vec3f from, Sample2d u) const;
  std::uint32_t environment_index() const {
    return static_cast<std::uint32_t>(area_lights_.list().size() + punctual_lights_.size());
  }
  float choice_probability(const LightReference& at, std::span<const float> spectra, int spectrum,
                           std::uint32_t light) const;

  /// Lights are numbered through: area lights, punctual lights, the environment.
  AreaLights area_lights_;
  std::vector<PunctualLight> punctual_lights_;
  std::shared_ptr<const Environment> environment_;
  std::vector<Group> groups_;         ///< of each emission spectrum, or one of all
  std::vector<PlaceInGroup> places_;  ///< of each light
  std::vector<double> power_of_spectrum_;
  std::vector<std::size_t> lit_groups_;  ///< those that have lights, at most kMostGroups
  bool uses_normals_ = false;
  std::optional<std::uint32_t> only_area_light_;  ///< where there is no other light
};

inline LightSampler::Pick LightSampler::pick(std::span<const float> spectra, double u_choice) const {
  // The spectrum.
  std::size_t k = lit_groups_.front();
  float probability = 1.0f;
  if (!spectra.empty()) {
    for (k = 0; k < spectra.size() && u_choice >= spectra[k]; ++k) u_choice -= spectra[k];
    if (k == spectra.size()) return {};
    probability = spectra[k];
    u_choice = std::min(u_choice / probability, 1.0 - 0x1p-53);
  }

  // The light.
  const Group& group = groups_[k];
  const std::uint32_t entry = group.table.sample(u_choice), light = group.lights[entry];
  probability *= group.table.probability(entry);
  return {light, probability, light == kNoLight ? &group.tree : nullptr, u_choice};
}

}  // namespace photopic
