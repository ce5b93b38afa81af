#include "support/instances.h"

#include <set>

#include "core/surface_point.h"

namespace photopic::test {
namespace {

Affine to_double(const Affinef& m) {
  return {photopic::to_double(m.x), photopic::to_double(m.y), photopic::to_double(m.z),
          photopic::to_double(m.t)};
}

}  // namespace

Scene with_instances(Scene scene, const std::vector<Affine>& places) {
  Geometry& g = scene.geometry;
  const Shape& shape = g.shapes.back();
  std::set<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < shape.triangle_count; ++i)
    for (const std::uint32_t corner : g.triangles[shape.first_triangle + i]) corners.insert(corner);
  Vec3d low{INFINITY, INFINITY, INFINITY}, high = -low;
  for (const std::uint32_t corner : corners) {
    const Vec3d p = photopic::to_double(g.positions[corner]);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3d middle = (low + high) * 0.5;
  for (const std::uint32_t corner : corners)
    g.positions[corner] = to_float(photopic::to_double(g.positions[corner]) - middle);
  g.prototypes.push_back({static_cast<std::uint32_t>(g.shapes.size() - 1), 1});
  for (const Affine& place : places)
    g.instances.push_back({round_to_float(place), 0, instance_error(place, high - middle)});
  return scene;
}

Scene baked(const Scene& scene) {
  Scene result = scene;
  Geometry& g = result.geometry;
  g.prototypes.clear(), g.instances.clear();
  const Geometry& source = scene.geometry;
  g.shapes.resize(source.baked_shape_count());
  for (const Instance& instance : source.instances) {
    const Affine m = to_double(instance.to_world);
    const Prototype& prototype = source.prototypes[instance.prototype];
    for (std::uint32_t s = 0; s < prototype.shape_count; ++s) {
      const Shape& shape = source.shapes[prototype.first_shape + s];
      g.shapes.push_back(
          {static_cast<std::uint32_t>(g.triangles.size()), shape.triangle_count, shape.material});
      for (std::uint32_t i = 0; i < shape.triangle_count; ++i) {
        const auto first = static_cast<std::uint32_t>(g.positions.size());
        for (const std::uint32_t corner : source.triangles[shape.first_triangle + i]) {
          g.positions.push_back(to_float(m.point(photopic::to_double(source.positions[corner]))));
          const Vec3d n = m.normal(photopic::to_double(source.normals[corner]));
          g.normals.push_back(length(n) > 0 ? to_float(normalize(n)) : Vec3f{});
        }
        g.triangles.push_back({first, first + 1, first + 2});
        if (m.determinant() < 0) std::swap(g.triangles.back()[1], g.triangles.back()[2]);
      }
    }
  }
  // The prototypes' triangles are no shape's any more, so the shapes no longer cover them: that is allowed.
  return result;
}

Affine placement(Vec3d scale, Vec3d axis, double radians, Vec3d move) {
  const Vec3d k = normalize(axis) * std::sin(0.5 * radians);
  Affine m = rotation(k.x, k.y, k.z, std::cos(0.5 * radians)).value();
  m.x = m.x * scale.x, m.y = m.y * scale.y, m.z = m.z * scale.z;
  m.t = move;
  return m;
}

}  // namespace photopic::test
