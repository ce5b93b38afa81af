#include "core/gltf/geometry.h"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "core/gltf/accessor.h"

namespace photopic {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr std::size_t kMaxVertices = 100'000'000, kMaxTriangles = 100'000'000;  // some 4 GB, instances baked
constexpr double kMaxCoordinate = 1e15;                                         // its square fits a float

/// One primitive of one mesh under one node.
struct Part {
  int node, mesh, primitive;
  Affine to_world;

  const tinygltf::Primitive& in(const GltfDocument& document) const {
    return document.model.meshes[mesh].primitives[primitive];
  }
  std::string pointer() const { return fmt::format("/meshes/{}/primitives/{}", mesh, primitive); }
};

int position_accessor(const tinygltf::Primitive& primitive) {
  return primitive.attributes.at("POSITION");
}

/// What was mended or left out, counted for one warning each.
struct Tally {
  std::size_t not_triangles = 0, no_positions = 0, degenerate = 0, left_over = 0, flattened = 0,
              zero_normals = 0;
  bool morphs = false, skins = false;

  void report(std::vector<std::string>& warnings) const {
    const auto add = [&](std::size_t count, const char* text) {
      if (count > 0) warnings.push_back(fmt::format("{}: {}", text, count));
    };
    add(not_triangles, "primitives of points or lines, not rendered");
    add(no_positions, "primitives without POSITION, not rendered");
    add(degenerate, "triangles of zero area, dropped");
    add(left_over, "primitives whose last vertices make no whole triangle, dropped");
    add(flattened, "meshes flattened by a scale of zero");
    add(zero_normals, "vertices with a normal of zero length, shaded flat");
    if (morphs) warnings.emplace_back("morph targets are ignored: meshes stay at rest");
    if (skins) warnings.emplace_back("skins are ignored: meshes stay in their rest pose");
  }
};

std::vector<Part> list_parts(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                             Tally& tally) {
  std::vector<Part> parts;
  for (const NodeInstance& instance : instances) {
    const tinygltf::Node& node = document.model.nodes[instance.node];
    if (node.mesh < 0) continue;
    tally.skins |= node.skin >= 0;
    if (instance.to_world.determinant() == 0) ++tally.flattened;
    const auto& primitives = document.model.meshes[node.mesh].primitives;
    for (int i = 0; i < static_cast<int>(primitives.size()); ++i) {
      tally.morphs |= !primitives[i].targets.empty();
      const int mode = primitives[i].mode;
      const bool triangles =
          mode == -1 || (mode >= TINYGLTF_MODE_TRIANGLES && mode <= TINYGLTF_MODE_TRIANGLE_FAN);
      if (!triangles)
        ++tally.not_triangles;
      else if (!primitives[i].attributes.contains("POSITION"))
        ++tally.no_positions;
      else
        parts.push_back({instance.node, node.mesh, i, instance.to_world});
    }
  }
  return parts;
}

std::size_t corner_count(const GltfDocument& document, const tinygltf::Primitive& primitive) {
  return document.model.accessors[primitive.indices >= 0 ? primitive.indices : position_accessor(primitive)]
      .count;
}

std::size_t triangle_count(const tinygltf::Primitive& primitive, std::size_t corners) {
  const bool list = primitive.mode == -1 || primitive.mode == TINYGLTF_MODE_TRIANGLES;
  return list ? corners / 3 : corners >= 3 ? corners - 2 : 0;
}

/// Corner numbers of triangle i (glTF 2.0, section 3.7.2.1): strips alternate their winding, fans share
/// corner 0.
Triangle corners_of(const tinygltf::Primitive& primitive, std::uint32_t i) {
  if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) return {i, i + 1 + i % 2, i + 2 - i % 2};
  if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) return {i + 1, i + 2, 0};
  return {3 * i, 3 * i + 1, 3 * i + 2};
}

void reserve(const GltfDocument& document, const std::vector<Part>& parts, Geometry& geometry) {
  std::size_t vertices = 0, triangles = 0;
  for (const Part& part : parts) {
    vertices += document.model.accessors[position_accessor(part.in(document))].count;
    triangles += triangle_count(part.in(document), corner_count(document, part.in(document)));
    if (vertices > kMaxVertices || triangles > kMaxTriangles) {
      document.fail(
          fmt::format("/nodes/{}", part.node),
          fmt::format("the scene's instances hold more than {} vertices or triangles", kMaxVertices),
          "split the scene or thin it out");
    }
  }
  geometry.positions.reserve(vertices);
  geometry.normals.reserve(vertices);
  geometry.triangles.reserve(triangles);
  geometry.shapes.reserve(parts.size());
}

Vec3d bounding_box_middle(const GltfDocument& document, const std::vector<Part>& parts) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3d low{kInfinity, kInfinity, kInfinity}, high = -low;
  for (const Part& part : parts) {
    for (const Vec3f& position : read_vec3(document, position_accessor(part.in(document)))) {
      const Vec3d p = part.to_world.point(to_double(position));
      if (!(max_abs(p) <= kMaxCoordinate)) {
        document.fail(fmt::format("/nodes/{}", part.node),
                      fmt::format("its mesh reaches beyond {} m", kMaxCoordinate),
                      "correct the positions or scales");
      }
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  return parts.empty() ? Vec3d{} : (low + high) * 0.5;
}

void append_normals(const GltfDocument& document, const Part& part, std::size_t count, Geometry& geometry,
                    Tally& tally) {
  const auto attribute = part.in(document).attributes.find("NORMAL");
  if (attribute == part.in(document).attributes.end()) {
    geometry.normals.resize(geometry.normals.size() + count);
    return;
  }
  const std::vector<Vec3f> normals = read_vec3(document, attribute->second);
  if (normals.size() != count) {
    document.fail(part.pointer() + "/attributes/NORMAL",
                  fmt::format("there are {} normals for {} positions", normals.size(), count));
  }
  for (const Vec3f& normal : normals) {
    // Scaled first, so that neither tiny nor huge transformations underflow or overflow in the square.
    Vec3d n = part.to_world.normal(to_double(normal));
    const double scale = max_abs(n);
    n = scale > 0 && std::isfinite(scale) ? normalize(n / scale) : Vec3d{};
    if (n == Vec3d{}) ++tally.zero_normals;
    geometry.normals.push_back(to_float(n));
  }
}

/// Whether a renderer in single precision sees no area: the squared length of the normal underflows.
bool is_degenerate(const Geometry& geometry, const Triangle& t) {
  const Vec3f a = geometry.positions[t[0]];
  const Vec3f n = cross(geometry.positions[t[1]] - a, geometry.positions[t[2]] - a);
  return !(dot(n, n) >= std::numeric_limits<float>::min());
}

void append_triangles(const GltfDocument& document, const Part& part, std::uint32_t first_vertex,
                      std::size_t vertices, Geometry& geometry, Tally& tally) {
  const tinygltf::Primitive& primitive = part.in(document);
  const std::vector<std::uint32_t> indices =
      primitive.indices >= 0 ? read_indices(document, primitive.indices) : std::vector<std::uint32_t>{};
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= vertices)
      document.fail(part.pointer() + "/indices",
                    fmt::format("index {} at {} lies beyond the {} vertices", indices[i], i, vertices));
  }
  const std::size_t corners = corner_count(document, primitive), count = triangle_count(primitive, corners);
  const bool list = primitive.mode == -1 || primitive.mode == TINYGLTF_MODE_TRIANGLES;
  if (list ? corners % 3 != 0 : corners < 3) ++tally.left_over;

  const bool mirrored = part.to_world.determinant() < 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    Triangle triangle = corners_of(primitive, i);
    for (std::uint32_t& corner : triangle)
      corner = first_vertex + (indices.empty() ? corner : indices[corner]);
    if (mirrored) std::swap(triangle[1], triangle[2]);
    if (is_degenerate(geometry, triangle))
      ++tally.degenerate;
    else
      geometry.triangles.push_back(triangle);
  }
}

void append_part(const GltfDocument& document, const Part& part, Scene& scene, Tally& tally) {
  Geometry& geometry = scene.geometry;
  const auto first_vertex = static_cast<std::uint32_t>(geometry.positions.size());
  const auto first_triangle = static_cast<std::uint32_t>(geometry.triangles.size());
  const std::vector<Vec3f> positions = read_vec3(document, position_accessor(part.in(document)));
  for (const Vec3f& p : positions)
    geometry.positions.push_back(to_float(part.to_world.point(to_double(p)) - scene.origin));
  append_normals(document, part, positions.size(), geometry, tally);
  append_triangles(document, part, first_vertex, positions.size(), geometry, tally);

  const auto count = static_cast<std::uint32_t>(geometry.triangles.size()) - first_triangle;
  const int material = part.in(document).material;
  const auto material_index =
      material >= 0 ? static_cast<std::size_t>(material) : document.model.materials.size();
  if (count > 0)
    geometry.shapes.push_back({first_triangle, count, static_cast<std::uint32_t>(material_index)});
}

}  // namespace

void load_gltf_geometry(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                        Scene& scene) {
  Tally tally;
  const std::vector<Part> parts = list_parts(document, instances, tally);
  reserve(document, parts, scene.geometry);
  scene.origin = bounding_box_middle(document, parts);
  for (const Part& part : parts) append_part(document, part, scene, tally);
  tally.report(scene.warnings);
}

}  // namespace photopic
