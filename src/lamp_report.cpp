#include <fmt/format.h>

#include <numbers>
#include <vector>

#include "core/framing.h"
#include "core/lights/area_light.h"
#include "scene_report.h"
#include "spectral/lamp_description.h"

namespace photopic {
namespace {

using Json = nlohmann::ordered_json;

/// A row of the table, and an object of the JSON.
class LampList {
 public:
  explicit LampList(const Scene& scene) : scene_(scene) {
    section.json = Json::array();
    for (const TabulatedSpectrum& spectrum : scene.emission_spectra)
      descriptions_.push_back(describe_lamp(spectrum));
  }

  /// @param amount what of, and in which unit: "luminance_cd_per_m2"
  /// @param area   [m²]; 0: a lamp without
  void add(const std::string& name, const std::string& type, int emission, double value,
           const std::string& amount, const std::string& unit, double area, double flux) {
    const auto spectrum = static_cast<std::size_t>(emission);
    const LampDescription& lamp = descriptions_[spectrum];
    const std::string& spectrum_name = scene_.emission_names[spectrum];
    const bool has_kelvin = lamp.temperature && lamp.temperature->meaningful();
    section.rows.push_back({name_text(name), type, spectrum_name,
                            has_kelvin ? fmt::format("{:.0f} K", lamp.temperature->kelvin) : "-",
                            fmt::format("{:.4g} {}", value, unit),
                            area > 0.0 ? fmt::format("{:.4g}", area) : "-", fmt::format("{:.4g}", flux)});
    Json json = {{"name", name},
                 {"type", type},
                 {"spectrum", spectrum_name},
                 {"x", lamp.chromaticity.x},
                 {"y", lamp.chromaticity.y},
                 {amount, value}};
    if (area > 0.0) json["area_m2"] = area;
    json["flux_lm"] = flux;
    section.json.push_back(std::move(json));
  }
  void add_unused(const GltfContents::Named& light) {
    section.rows.push_back({name_text(light.name), light.type, "not used"});
    section.json.push_back({{"name", light.name}, {"type", light.type}, {"used", false}});
  }

  ReportSection section{"lamps",
                        "lamps",
                        {{"name", "type", "spectrum", "temperature", "brightness", "area [m2]", "flux [lm]"}},
                        {}};

 private:
  const Scene& scene_;
  std::vector<LampDescription> descriptions_;  ///< of the emission spectra
};

/// Glowing materials, each with all its surfaces.
void add_surfaces(const Scene& scene, LampList& lamps) {
  struct Sum {
    double area = 0.0, luminance_area = 0.0, flux = 0.0;
  };
  const std::vector<Surface> surfaces(scene.materials.begin(), scene.materials.end());
  std::vector<Sum> sums(scene.materials.size());
  const AreaLights lights(scene, surfaces);
  for (std::uint32_t i = 0; i < lights.list().size(); ++i) {
    const AreaLight& light = lights.list()[i];
    Sum& sum = sums[light.material];
    sum.area += light.area;
    sum.luminance_area += static_cast<double>(lights.mean_luminance(i)) * light.area;
    sum.flux += lights.power(i);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Material& m = scene.materials[i];
    if (!(sums[i].area > 0.0)) continue;
    lamps.add(m.name, m.unlit ? "unlit surface" : "surface", m.emission_spectrum,
              sums[i].luminance_area / sums[i].area, "luminance_cd_per_m2", "cd/m2", sums[i].area,
              sums[i].flux);
  }
}

void add_punctual(const Scene& scene, const GltfContents& contents, double radius, LampList& lamps) {
  std::vector<bool> used(contents.lights.size());
  for (const PunctualLight& light : scene.punctual_lights) {
    const bool distant = light.kind == PunctualLight::Kind::directional;
    const char* type = distant ? "directional" : light.kind == PunctualLight::Kind::spot ? "spot" : "point";
    lamps.add(light.name, type, light.emission_spectrum, light.intensity,
              distant ? "illuminance_lx" : "intensity_cd", distant ? "lx" : "cd", 0.0, light.power(radius));
    if (light.index >= 0) used[static_cast<std::size_t>(light.index)] = true;
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i]) lamps.add_unused(contents.lights[i]);
}

void add_environment(const Environment& environment, double radius, LampList& lamps) {
  const double luminance = environment.flux_density() / (4.0 * std::numbers::pi);
  lamps.add("environment", "environment", environment.emission_spectrum, luminance, "luminance_cd_per_m2",
            "cd/m2", 0.0, environment.flux_density() * std::numbers::pi * radius * radius);
}

}  // namespace

ReportSection report_lamps(const Scene& scene, const GltfContents& contents) {
  const double radius = bounding_sphere(scene.geometry).radius;
  LampList lamps(scene);
  add_surfaces(scene, lamps);
  add_punctual(scene, contents, radius, lamps);
  if (scene.environment) add_environment(*scene.environment, radius, lamps);
  return lamps.section;
}

}  // namespace photopic
