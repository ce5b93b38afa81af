#include "core/framing.h"

namespace photopic {
namespace {

template <typename Visit>
void for_each_corner(const Geometry& geometry, const Shape& shape, const Visit& visit) {
  for (std::uint32_t i = 0; i < shape.triangle_count; ++i)
    for (const std::uint32_t corner : geometry.triangles[shape.first_triangle + i])
      visit(geometry.positions[corner]);
}

/// Calls visit(point) for every corner of a triangle in the world, and of an instance's box.
template <typename Visit>
void for_each_point(const Geometry& geometry, const Visit& visit) {
  for (std::size_t s = 0; s < geometry.baked_shape_count(); ++s)
    for_each_corner(geometry, geometry.shapes[s], visit);
  std::vector<Boxf> boxes(geometry.prototypes.size());
  for (std::size_t p = 0; p < boxes.size(); ++p) {
    const Prototype& prototype = geometry.prototypes[p];
    for (std::size_t s = 0; s < prototype.shape_count; ++s)
      boxes[p].add(box_of(geometry, geometry.shapes[prototype.first_shape + s]));
  }
  for (const Instance& instance : geometry.instances) {
    const Boxf& box = boxes[instance.prototype];
    if (box.is_empty()) continue;
    for (int i = 0; i < 8; ++i) visit(instance.to_world.point(box.corner(i)));
  }
}

}  // namespace

Boxf box_of(const Geometry& geometry, const Shape& shape) {
  Boxf box;
  for_each_corner(geometry, shape, [&](Vec3f point) { box.add(point); });
  return box;
}

BoundingBox bounding_box(const Geometry& geometry) {
  Boxf box;
  for_each_point(geometry, [&](Vec3f point) { box.add(point); });
  return box.is_empty() ? BoundingBox{} : BoundingBox{box.low, box.high};
}

BoundingSphere bounding_sphere(const Geometry& geometry) {
  const BoundingBox box = bounding_box(geometry);
  BoundingSphere sphere{(box.low + box.high) * 0.5f};
  for_each_point(
      geometry, [&](Vec3f point) { sphere.radius = std::max(sphere.radius, length(point - sphere.middle)); });
  return sphere;
}

void frame(const BoundingSphere& sphere, Camera& camera) {
  constexpr float kMargin = 1.05f;
  constexpr float kHalfAngle = 20.0f * kPi / 180.0f;  // of the view, across the picture's shorter side
  const float aspect = static_cast<float>(camera.width) / static_cast<float>(camera.height);
  camera.half_height = 0.0f;
  camera.tan_half_yfov = std::tan(kHalfAngle) / std::min(aspect, 1.0f);

  const float azimuth = kPi / 6.0f, elevation = kPi / 9.0f;
  camera.back = {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                 std::cos(azimuth) * std::cos(elevation)};
  camera.right = normalize(cross(Vec3f{0, 1, 0}, camera.back));
  camera.up = cross(camera.back, camera.right);
  const float radius = sphere.radius > 0.0f ? sphere.radius * kMargin : 1.0f;
  camera.position = sphere.middle + camera.back * (radius / std::sin(kHalfAngle));
}

}  // namespace photopic
