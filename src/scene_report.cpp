#include "scene_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/surface.h"
#include "spectral/lamp_description.h"

namespace photopic {
namespace {

using Json = nlohmann::ordered_json;

/// Embree's tree at high build quality, robust; measured on a height field of a million triangles.
constexpr double kTreeBytesPerTriangle = 60;

template <typename T>
std::size_t bytes_of(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

std::size_t geometry_bytes(const Geometry& g) {
  std::size_t bytes = bytes_of(g.positions) + bytes_of(g.triangles) + bytes_of(g.shapes) +
                      bytes_of(g.normals) + bytes_of(g.tangents) + bytes_of(g.colors);
  for (const auto& set : g.uvs) bytes += bytes_of(set);
  return bytes;
}

struct Bounds {
  Vec3d low, high;
};
Bounds world_bounds(const Scene& scene) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Vec3f low{kInfinity, kInfinity, kInfinity}, high = -low;
  for (const Vec3f& p : scene.geometry.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  if (scene.geometry.positions.empty()) low = high = {};
  return {to_double(low) + scene.origin, to_double(high) + scene.origin};
}

std::string point_text(Vec3d p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z);
}
Json point_json(Vec3d p) {
  return {p.x, p.y, p.z};
}

/// Area of each material's triangles [m²].
std::vector<double> material_areas(const Scene& scene) {
  std::vector<double> areas(scene.materials.size());
  const Geometry& g = scene.geometry;
  for (const Shape& shape : g.shapes)
    for (std::uint32_t i = 0; i < shape.triangle_count; ++i) {
      const auto& [a, b, c] = g.triangles[shape.first_triangle + i];
      const Vec3d v = to_double(g.positions[a]);
      areas[shape.material] +=
          0.5 * length(cross(to_double(g.positions[b]) - v, to_double(g.positions[c]) - v));
    }
  return areas;
}

std::string temperature_text(const LampDescription& lamp) {
  return lamp.temperature && lamp.temperature->meaningful()
             ? fmt::format("{:.0f} K", lamp.temperature->kelvin)
             : "-";
}

/// Where a texture varies it, that of a white texel [cd/m²].
double largest_luminance(const Material& m) {
  const Vec3f factor = m.emissive_factor;
  const double tint = Surface(m).emission_varies ? linear_srgb_to_xyz({factor.x, factor.y, factor.z}).y : 1.0;
  return m.emission_luminance * tint;
}

}  // namespace

std::string name_text(const std::string& name) {
  return name.empty() ? "(no name)" : name;
}

std::string size_text(double bytes) {
  return bytes < 1e6 ? fmt::format("{:.1f} kB", bytes * 1e-3) : fmt::format("{:.1f} MB", bytes * 1e-6);
}

ReportSection report_geometry(const Scene& scene) {
  const Geometry& g = scene.geometry;
  const Bounds bounds = world_bounds(scene);
  const Vec3d size = bounds.high - bounds.low;
  const auto stored = static_cast<double>(geometry_bytes(g));
  const double tree = kTreeBytesPerTriangle * static_cast<double>(g.triangles.size());
  ReportSection section{"geometry", "geometry", {}, {}};
  section.rows = {
      {"triangles", std::to_string(g.triangles.size())},
      {"vertices", std::to_string(g.positions.size())},
      {"shapes", std::to_string(g.shapes.size())},
      {"bounds [m]", point_text(bounds.low) + " to " + point_text(bounds.high)},
      {"size [m]", fmt::format("{:.4g} x {:.4g} x {:.4g}", size.x, size.y, size.z)},
      {"memory", fmt::format("{} and about {} of Embree's tree", size_text(stored), size_text(tree))},
  };
  section.json = {{"triangles", g.triangles.size()},
                  {"vertices", g.positions.size()},
                  {"shapes", g.shapes.size()},
                  {"bounds_m", {point_json(bounds.low), point_json(bounds.high)}},
                  {"bytes", stored},
                  {"tree_bytes_estimate", tree}};
  return section;
}

ReportSection report_cameras(const Scene& scene, const GltfContents& contents) {
  ReportSection section{
      "cameras", "cameras", {{"name", "type", "position [m]", "field of view", "image"}}, {}};
  section.json = Json::array();
  bool found = false;
  for (const GltfContents::Named& camera : contents.cameras) {
    const bool used = !found && scene.camera.width > 0 && camera.name == scene.camera_name;
    found |= used;
    Json json = {{"name", camera.name}, {"type", camera.type}, {"used", used}};
    std::vector<std::string> row = {name_text(camera.name), camera.type, "", "", "not used"};
    if (used) {
      const Vec3d position = to_double(scene.camera.position) + scene.origin;
      const double yfov = 2.0 * std::atan(scene.camera.tan_half_yfov) * 180.0 / std::numbers::pi;
      row[2] = point_text(position);
      row[3] = fmt::format("{:.1f}°", yfov);
      row[4] = fmt::format("{}x{}", scene.camera.width, scene.camera.height);
      json["position_m"] = point_json(position);
      json["yfov_degrees"] = yfov;
      json["resolution"] = {scene.camera.width, scene.camera.height};
    }
    section.rows.push_back(std::move(row));
    section.json.push_back(std::move(json));
  }
  return section;
}

ReportSection report_lamps(const Scene& scene, const GltfContents& contents) {
  ReportSection section{
      "lamps",
      "lamps",
      {{"name", "type", "spectrum", "temperature", "luminance [cd/m2]", "area [m2]", "flux [lm]"}},
      {}};
  section.json = Json::array();
  const std::vector<double> areas = material_areas(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    if (m.emission_spectrum < 0) continue;
    const auto spectrum = static_cast<std::size_t>(m.emission_spectrum);
    const LampDescription lamp = describe_lamp(scene.emission_spectra[spectrum]);
    const bool varies = Surface(m).emission_varies;  // by a texture, or by vertex colours
    const std::string type = m.unlit ? "unlit surface" : "surface";
    const std::string& name = scene.emission_names[spectrum];
    const double luminance = largest_luminance(m);
    const double sides = m.double_sided ? 2.0 : 1.0;
    const double flux = std::numbers::pi * luminance * areas[i] * sides;  // of a Lambertian emitter
    const char* bound = varies ? "up to " : "";
    section.rows.push_back({name_text(m.name), type, name, temperature_text(lamp),
                            fmt::format("{}{:.4g}", bound, luminance), fmt::format("{:.4g}", areas[i]),
                            fmt::format("{}{:.4g}", bound, flux)});
    section.json.push_back({{"name", m.name},
                            {"type", type},
                            {"spectrum", name},
                            {"x", lamp.chromaticity.x},
                            {"y", lamp.chromaticity.y},
                            {varies ? "luminance_cd_per_m2_at_most" : "luminance_cd_per_m2", luminance},
                            {"area_m2", areas[i]},
                            {varies ? "flux_lm_at_most" : "flux_lm", flux}});
  }
  for (const GltfContents::Named& light : contents.lights) {
    section.rows.push_back({name_text(light.name), light.type, "not rendered"});
    section.json.push_back({{"name", light.name}, {"type", light.type}, {"rendered", false}});
  }
  return section;
}

}  // namespace photopic
