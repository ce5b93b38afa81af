#pragma once

#include "core/box.h"
#include "core/scene.h"

namespace photopic {

/// Around a shape's triangles [m], in the space that they were modelled in; empty without any.
Boxf box_of(const Geometry& geometry, const Shape& shape);

/// The box that holds every triangle (of instances: their prototypes' boxes), relative to Scene::origin [m];
/// zero without any.
struct BoundingBox {
  Vec3f low, high;
};
BoundingBox bounding_box(const Geometry& geometry);

/// The middle of the geometry's bounding box, relative to Scene::origin, and the radius of the sphere about
/// it that holds the same [m]. Radius 0 without any.
struct BoundingSphere {
  Vec3f middle;
  float radius = 0;
};
BoundingSphere bounding_sphere(const Geometry& geometry);

/// Turns and places the camera so that the sphere fills its view, seen from the front, the right and above (a
/// three-quarter view). Its resolution must be set.
void frame(const BoundingSphere& sphere, Camera& camera);

}  // namespace photopic
