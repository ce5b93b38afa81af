#include "scene_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/framing.h"
#include "core/surface.h"
#include "spectral/illuminants.h"
#include "spectral/lamp_description.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

using Json = nlohmann::ordered_json;

/// Embree's tree of single triangles: measured on scenes of 10,000 to 1 million triangles.
constexpr double kTreeBytesPerTriangle = 190;
constexpr double kTreeBytesPerInstance = 360;  // of 500,000 instances

template <typename T>
std::size_t bytes_of(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

std::size_t geometry_bytes(const Geometry& g) {
  std::size_t bytes = bytes_of(g.positions) + bytes_of(g.triangles) + bytes_of(g.shapes) +
                      bytes_of(g.instances) + bytes_of(g.normals) + bytes_of(g.tangents) + bytes_of(g.colors);
  for (const auto& set : g.uvs) bytes += bytes_of(set);
  return bytes;
}

std::string size_text(double bytes) {
  return bytes < 1e6 ? fmt::format("{:.1f} kB", bytes * 1e-3) : fmt::format("{:.1f} MB", bytes * 1e-6);
}

std::string name_text(const std::string& name) {
  return name.empty() ? "(no name)" : name;
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

std::vector<std::size_t> material_triangles(const Scene& scene) {
  std::vector<std::size_t> counts(scene.materials.size());
  for (const Shape& shape : scene.geometry.shapes) counts[shape.material] += shape.triangle_count;
  return counts;
}

/// The colour of a reflectance under D65, linear sRGB.
Rgb color_under_d65(const Spectrum& reflectance) {
  if (const auto* grey = std::get_if<ConstantSpectrum>(&reflectance))
    return {grey->value, grey->value, grey->value};
  static const TabulatedSpectrum d65 = tabulate_emission(cie_illuminant("D65").value());
  static const double white = emission_xyz(d65, Observer::cie1931()).y;
  return xyz_to_linear_srgb(emission_xyz(tabulate_product(reflectance, d65), Observer::cie1931()) *
                            (1.0 / white));
}

std::string kind_of(const Material& m) {
  const double glass = m.transmission * (1.0 - m.metallic);
  const std::string clear = m.thin_walled ? "thin glass" : "glass";
  if (glass >= 1.0) return clear;
  const Surface surface(m);
  const std::string opaque = surface.opaque_kind == BsdfKind::diffuse ? "diffuse"
                             : m.metallic >= 1.0f                     ? "metal"
                             : m.metallic > 0.0f                      ? "dielectric and metal"
                                                                      : "dielectric";
  return glass > 0.0 ? opaque + " and " + clear : opaque;
}

Json parameters_of(const Material& m) {
  Json json = {{"roughness", m.roughness}};
  const auto add = [&](const char* name, float value, float otherwise) {
    if (value != otherwise) json[name] = value;
  };
  add("metallic", m.metallic, 0.0f);
  add("ior", m.ior, 1.5f);
  add("specular", m.specular, 1.0f);
  add("transmission", m.transmission, 0.0f);
  add("attenuation_distance", m.attenuation_distance, 0.0f);
  if (m.double_sided) json["double_sided"] = true;
  return json;
}

std::string parameters_text(const Json& parameters) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : parameters.items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    parts.push_back(value.is_boolean() ? words : fmt::format("{} {:.4g}", words, value.get<double>()));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string temperature_text(const LampDescription& lamp) {
  return lamp.temperature && lamp.temperature->meaningful()
             ? fmt::format("{:.0f} K", lamp.temperature->kelvin)
             : "-";
}

}  // namespace

ReportSection report_geometry(const Scene& scene) {
  const Geometry& g = scene.geometry;
  const BoundingBox box = bounding_box(g);
  const Vec3d low = to_double(box.low) + scene.origin, high = to_double(box.high) + scene.origin;
  const Vec3d size = high - low;
  const auto stored = static_cast<double>(geometry_bytes(g));
  const double tree = kTreeBytesPerTriangle * static_cast<double>(g.triangles.size()) +
                      kTreeBytesPerInstance * static_cast<double>(g.instances.size());
  ReportSection section{"geometry", "geometry", {}, {}};
  section.rows = {
      {"triangles", std::to_string(g.triangles.size())},
      {"vertices", std::to_string(g.positions.size())},
      {"shapes", std::to_string(g.shapes.size())},
      {"instances", fmt::format("{} of {} meshes", g.instances.size(), g.prototypes.size())},
      {"bounds [m]", point_text(low) + " to " + point_text(high)},
      {"size [m]", fmt::format("{:.4g} x {:.4g} x {:.4g}", size.x, size.y, size.z)},
      {"memory", fmt::format("{} and about {} of Embree's tree", size_text(stored), size_text(tree))},
  };
  section.json = {{"triangles", g.triangles.size()},
                  {"vertices", g.positions.size()},
                  {"shapes", g.shapes.size()},
                  {"instances", g.instances.size()},
                  {"shared_meshes", g.prototypes.size()},
                  {"bounds_m", {point_json(low), point_json(high)}},
                  {"bytes", stored},
                  {"tree_bytes_estimate", tree}};
  return section;
}

ReportSection report_cameras(const Scene& scene, const GltfContents& contents) {
  ReportSection section{
      "cameras", "cameras", {{"name", "type", "position [m]", "field of view", "image"}}, {}};
  section.json = Json::array();
  const Camera& camera = scene.camera;
  const auto add = [&](const std::string& name, const std::string& type, bool used) {
    Json json = {{"name", name}, {"type", type}, {"used", used}};
    std::vector<std::string> row = {name_text(name), type, "", "", "not used"};
    if (used) {
      const Vec3d position = to_double(camera.position) + scene.origin;
      const double yfov = 2.0 * std::atan(camera.tan_half_yfov) * 180.0 / std::numbers::pi;
      const double height = 2.0 * camera.half_height;
      row[2] = point_text(position);
      row[3] = camera.orthographic() ? fmt::format("{:.4g} m", height) : fmt::format("{:.1f}°", yfov);
      row[4] = fmt::format("{}x{}", camera.width, camera.height);
      json["position_m"] = point_json(position);
      json[camera.orthographic() ? "height_m" : "yfov_degrees"] = camera.orthographic() ? height : yfov;
      json["resolution"] = {camera.width, camera.height};
      if (camera.has_lens()) {
        json["aperture_radius_m"] = camera.aperture_radius;
        json["focus_distance_m"] = camera.focus_distance;
      }
    }
    section.rows.push_back(std::move(row));
    section.json.push_back(std::move(json));
  };
  bool found = false;
  for (const GltfContents::Named& listed : contents.cameras) {
    const bool used = !found && listed.name == scene.camera_name;
    found |= used;
    add(listed.name, listed.type, used);
  }
  if (!found) add(scene.camera_name, "perspective", true);  // the one that frames the scene
  return section;
}

ReportSection report_materials(const Scene& scene) {
  ReportSection section{
      "materials", "materials", {{"name", "kind", "color (linear sRGB)", "triangles", "parameters"}}, {}};
  section.json = Json::array();
  const std::vector<std::size_t> triangles = material_triangles(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    if (i + 1 == scene.materials.size() && triangles[i] == 0) break;  // glTF's default, not used
    const Rgb color = color_under_d65(m.base_color);
    const Json parameters = parameters_of(m);
    section.rows.push_back(
        {m.name, kind_of(m), fmt::format("{:.3f} {:.3f} {:.3f}", color.r, color.g, color.b),
         triangles[i] > 0 ? std::to_string(triangles[i]) : "not used", parameters_text(parameters)});
    section.json.push_back({{"name", m.name},
                            {"kind", kind_of(m)},
                            {"color_linear_srgb", {color.r, color.g, color.b}},
                            {"triangles", triangles[i]},
                            {"parameters", parameters}});
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
    const double sides = m.double_sided ? 2.0 : 1.0;
    const double flux =
        std::numbers::pi * m.emission_luminance * areas[i] * sides;  // of a Lambertian emitter
    const std::string& name = scene.emission_names[spectrum];
    section.rows.push_back({name_text(m.name), "surface", name, temperature_text(lamp),
                            fmt::format("{:.4g}", m.emission_luminance), fmt::format("{:.4g}", areas[i]),
                            fmt::format("{:.4g}", flux)});
    section.json.push_back({{"name", m.name},
                            {"type", "surface"},
                            {"spectrum", name},
                            {"x", lamp.chromaticity.x},
                            {"y", lamp.chromaticity.y},
                            {"luminance_cd_per_m2", m.emission_luminance},
                            {"area_m2", areas[i]},
                            {"flux_lm", flux}});
  }
  for (const GltfContents::Named& light : contents.lights) {
    section.rows.push_back({name_text(light.name), light.type, "not rendered"});
    section.json.push_back({{"name", light.name}, {"type", light.type}, {"rendered", false}});
  }
  return section;
}

}  // namespace photopic
