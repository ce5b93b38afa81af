#include "scene_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/framing.h"
#include "core/quads.h"

namespace photopic {
namespace {

using Json = nlohmann::ordered_json;

/// Embree's tree at high build quality, robust, measured on height fields of up to ten million triangles; and
/// where it is made of pairs of them.
constexpr double kTreeBytesPerTriangle = 65, kTreeBytesPerPairedTriangle = 48;
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

std::string point_text(Vec3d p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z);
}
Json point_json(Vec3d p) {
  return {p.x, p.y, p.z};
}

}  // namespace

std::string name_text(const std::string& name) {
  return name.empty() ? "(no name)" : name;
}

std::string size_text(double bytes) {
  if (bytes < 1e3) return fmt::format("{:.0f} B", bytes);
  return bytes < 1e6 ? fmt::format("{:.1f} kB", bytes * 1e-3) : fmt::format("{:.1f} MB", bytes * 1e-6);
}

ReportSection report_geometry(const Scene& scene) {
  const Geometry& g = scene.geometry;
  const BoundingBox box = bounding_box(g);
  const Vec3d low = to_double(box.low) + scene.origin, high = to_double(box.high) + scene.origin;
  const Vec3d size = high - low;
  const auto stored = static_cast<double>(geometry_bytes(g));
  const double per_triangle = is_worth_pairing(g) ? kTreeBytesPerPairedTriangle : kTreeBytesPerTriangle;
  const double tree = per_triangle * static_cast<double>(g.triangles.size()) +
                      kTreeBytesPerInstance * static_cast<double>(g.instances.size());
  ReportSection section{"geometry", "geometry", {}, {}};
  section.rows = {
      {"triangles", std::to_string(g.triangles.size())},
      {"vertices", std::to_string(g.positions.size())},
      {"shapes", std::to_string(g.shapes.size())},
      {"bounds [m]", point_text(low) + " to " + point_text(high)},
      {"size [m]", fmt::format("{:.4g} x {:.4g} x {:.4g}", size.x, size.y, size.z)},
      {"memory", fmt::format("{} and about {} of Embree's tree", size_text(stored), size_text(tree))},
  };
  if (!g.instances.empty())
    section.rows.push_back(
        {"instances", fmt::format("{} of {} meshes", g.instances.size(), g.prototypes.size())});
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

ReportSection report_scenes(const Scene& scene, const GltfContents& contents) {
  ReportSection section{"scenes", "scenes", {}, Json::array()};
  for (std::size_t i = 0; i < contents.scenes.size(); ++i) {
    const bool used = static_cast<int>(i) == scene.scene_index;
    section.json.push_back({{"name", contents.scenes[i]}, {"used", used}});
    if (contents.scenes.size() > 1)
      section.rows.push_back(
          {std::to_string(i), name_text(contents.scenes[i]), used ? "rendered" : "not used"});
  }
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
  for (std::size_t i = 0; i < contents.cameras.size(); ++i) {
    const GltfContents::Named& listed = contents.cameras[i];
    const bool used = static_cast<int>(i) == scene.camera_index;
    add(used ? scene.camera_name : listed.name, listed.type, used);
  }
  if (scene.camera_index < 0) add(scene.camera_name, "perspective", true);
  return section;
}

}  // namespace photopic
