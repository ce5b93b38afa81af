#include "core/gltf/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/box.h"
#include "core/gltf/geometry_plan.h"
#include "core/gltf/skin.h"
#include "core/gltf/vertex_selection.h"
#include "core/surface_point.h"

namespace photopic {
namespace {

constexpr double kMaxCoordinate = 1e12;  // below kFarthest; its cube fits a float

/// Scaled first, so that neither tiny nor huge transformations underflow or overflow in the square.
Vec3f unit_or_zero(Vec3d v) {
  const double scale = max_abs(v);
  return scale > 0 && std::isfinite(scale) ? to_float(normalize(v / scale)) : Vec3f{};
}

/// Whether a renderer in single precision sees no area: the squared length of the normal underflows.
bool is_degenerate(const Geometry& geometry, const Triangle& t) {
  const Vec3f a = geometry.positions[t[0]];
  const Vec3f n = cross(geometry.positions[t[1]] - a, geometry.positions[t[2]] - a);
  return !(dot(n, n) >= std::numeric_limits<float>::min());
}

class GeometryLoader {
 public:
  GeometryLoader(const GltfDocument& document, GeometryPlan plan, Scene& scene)
      : document_(document),
        plan_(std::move(plan)),
        scene_(scene),
        geometry_(scene.geometry),
        skins_(document) {}

  void load() {
    find_middles();
    allocate();
    for (const Part& part : plan_.baked) append(part, -scene_.origin, 0);
    for (std::size_t p = 0; p < plan_.prototypes.size(); ++p) {
      const auto first = static_cast<std::uint32_t>(geometry_.shapes.size());
      for (const Part& part : plan_.prototypes[p].parts) append(part, -boxes_[p].middle(), first);
      geometry_.prototypes.push_back({first, static_cast<std::uint32_t>(geometry_.shapes.size()) - first});
    }
    for (const auto& [prototype, place] : plan_.instances)
      append_instance(prototype, plan_.places[place].to_world);
    if (plan_.normals && is_flat()) geometry_.normals = {};
    plan_.tally.report(scene_.warnings);
  }

 private:
  int node_of(const Part& part) const { return part.place == kNoPlace ? -1 : plan_.places[part.place].node; }

  VertexMap map_of(const Part& part) {
    VertexMap map;
    if (part.place == kNoPlace) return map;
    const NodeInstance& place = plan_.places[part.place];
    map.whole = place.to_world;
    const int skin = document_.model.nodes[place.node].skin;
    if (skin >= 0) map.of_vertex = skins_.vertex_transforms(skin, part.primitive);
    return map;
  }

  void check_reach(Vec3d p, const std::string& pointer) const {
    if (!(max_abs(p) <= kMaxCoordinate))
      document_.fail(pointer, fmt::format("its mesh reaches beyond {} m", kMaxCoordinate),
                     "correct the positions or scales");
  }

  void add_to(Boxd& box, const Part& part) {
    const VertexMap map = map_of(part);
    const int node = node_of(part);
    const auto positions = read_morphed<Vec3f>(document_, part.primitive, node, "POSITION");
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vec3d p = map[i].point(to_double(positions[i]));
      check_reach(p, node < 0 ? part.primitive.pointer() : fmt::format("/nodes/{}", node));
      box.add(p);
    }
  }

  /// The scene's origin is the middle of its bounding box, a prototype's that of its own.
  void find_middles() {
    Boxd world;
    for (const Part& part : plan_.baked) add_to(world, part);
    for (const auto& prototype : plan_.prototypes) {
      boxes_.emplace_back();
      for (const Part& part : prototype.parts) add_to(boxes_.back(), part);
    }
    for (const auto& [prototype, place] : plan_.instances) {
      for (int i = 0; i < 8; ++i) {
        const Vec3d p = plan_.places[place].to_world.point(boxes_[prototype].corner(i));
        check_reach(p, fmt::format("/nodes/{}", plan_.places[place].node));
        world.add(p);
      }
    }
    scene_.origin = world.middle();
  }

  /// No array that no surface needs; no room beyond what is needed.
  void allocate() {
    const std::size_t vertices = plan_.vertices;
    // Embree and surface_points read 16 bytes at a time.
    geometry_.positions.reserve(vertices + 1);
    if (plan_.normals) geometry_.normals.reserve(vertices + 1);
    geometry_.positions.resize(vertices);
    geometry_.triangles.reserve(plan_.triangles);
    if (plan_.normals) geometry_.normals.resize(vertices);
    if (plan_.tangents) geometry_.tangents.resize(vertices);
    if (plan_.colors) geometry_.colors.resize(vertices, {1, 1, 1, 1});
    for (int set = 0; set < kUvSets; ++set)
      if (plan_.uv_sets >> set & 1) geometry_.uvs[static_cast<std::size_t>(set)].resize(vertices);
  }

  void append(const Part& part, Vec3d offset, std::uint32_t first_shape) {
    VertexMap map = map_of(part);
    map.translate(offset);
    const VertexSelection selection(document_, part.primitive);
    const auto positions = read_morphed<Vec3f>(document_, part.primitive, node_of(part), "POSITION");
    selection.for_each(positions.size(), [&](std::size_t to, std::size_t i) {
      geometry_.positions[vertices_ + to] = to_float(map[i].point(to_double(positions[i])));
    });
    append_directions(part, map, selection);
    append_coordinates(part, selection);
    append_triangles(part, selection, map[0].determinant() < 0, first_shape);
    vertices_ += static_cast<std::uint32_t>(stored_vertex_count(document_, part.primitive.in(document_)));
  }

  void append_directions(const Part& part, const VertexMap& map, const VertexSelection& selection) {
    if (plan_.normals) {
      const auto normals = read_morphed<Vec3f>(document_, part.primitive, node_of(part), "NORMAL");
      selection.for_each(normals.size(), [&](std::size_t to, std::size_t i) {
        const Vec3f n = unit_or_zero(map[i].normal(to_double(normals[i])));
        if (n == Vec3f{}) ++plan_.tally.zero_normals;
        geometry_.normals[vertices_ + to] = n;
      });
    }
    if (!plan_.tangents) return;
    // A mirror turns normal × tangent against the bitangent's image.
    const auto tangents = read_morphed<Vec4f>(document_, part.primitive, node_of(part), "TANGENT");
    selection.for_each(tangents.size(), [&](std::size_t to, std::size_t i) {
      const Vec3f t = unit_or_zero(map[i].vector({tangents[i].x, tangents[i].y, tangents[i].z}));
      const bool positive = (tangents[i].w >= 0) == (map[i].determinant() >= 0);
      geometry_.tangents[vertices_ + to] = {t.x, t.y, t.z, positive ? 1.0f : -1.0f};
    });
  }

  void append_coordinates(const Part& part, const VertexSelection& selection) {
    const auto copy = [&](const auto& values, auto& array) {
      selection.for_each(values.size(),
                         [&](std::size_t to, std::size_t i) { array[vertices_ + to] = values[i]; });
    };
    for (std::size_t set = 0; set < kUvSets; ++set) {
      if (geometry_.uvs[set].empty()) continue;
      const auto uvs =
          read_attribute<Vec2f>(document_, part.primitive, fmt::format("TEXCOORD_{}", set).c_str());
      copy(uvs, geometry_.uvs[set]);
      const bool wanted = scene_.materials.at(part.material).uv_sets >> set & 1;
      if (uvs.empty() && wanted) ++plan_.tally.no_coordinates;
    }
    if (!plan_.colors) return;
    bool limited = false;
    copy(read_colors(document_, part.primitive, limited), geometry_.colors);
    if (limited) ++plan_.tally.bright_colors;
  }

  /// Neighbours of the same material become one shape.
  void append_triangles(const Part& part, const VertexSelection& selection, bool mirrored,
                        std::uint32_t first_shape) {
    const auto first = static_cast<std::uint32_t>(geometry_.triangles.size());
    for_each_triangle(document_, part.primitive, [&](Triangle triangle) {
      for (std::uint32_t& corner : triangle) corner = vertices_ + selection.place_of(corner);
      if (mirrored) std::swap(triangle[1], triangle[2]);
      if (is_degenerate(geometry_, triangle))
        ++plan_.tally.degenerate;
      else
        geometry_.triangles.push_back(triangle);
    });
    if (has_left_over(document_, part.primitive.in(document_))) ++plan_.tally.left_over;

    const auto count = static_cast<std::uint32_t>(geometry_.triangles.size()) - first;
    auto& shapes = geometry_.shapes;
    if (count == 0) return;
    if (shapes.size() > first_shape && shapes.back().material == part.material)
      shapes.back().triangle_count += count;
    else
      shapes.push_back({first, count, part.material});
  }

  /// Whether all normals are the triangles' own, but for rounding.
  bool is_flat() const {
    constexpr double kRounding = 1e-5;  // [rad]
    return std::ranges::all_of(geometry_.triangles, [&](const Triangle& t) {
      const auto corner = [&](std::size_t k) { return to_double(geometry_.positions[t[k]]); };
      const Vec3d own = cross(corner(1) - corner(0), corner(2) - corner(0));
      return std::ranges::all_of(t, [&](std::uint32_t i) {
        return length(cross(own, to_double(geometry_.normals[i]))) <= kRounding * length(own);
      });
    });
  }

  void append_instance(std::uint32_t prototype, Affine to_world) {
    const Boxd& box = boxes_[prototype];
    to_world.t = to_world.point(box.middle()) - scene_.origin;
    geometry_.instances.push_back(
        {round_to_float(to_world), prototype, instance_error(to_world, box.high - box.middle())});
  }

  const GltfDocument& document_;
  GeometryPlan plan_;
  Scene& scene_;
  Geometry& geometry_;
  SkinPoses skins_;
  std::vector<Boxd> boxes_;     ///< of each prototype, in its mesh's own space
  std::uint32_t vertices_ = 0;  ///< appended so far
};

}  // namespace

void load_gltf_geometry(const GltfDocument& document, const std::vector<NodeInstance>& nodes, Scene& scene) {
  GeometryLoader(document, plan_gltf_geometry(document, nodes, scene.materials), scene).load();
}

}  // namespace photopic
