#include "support/instances.h"

#include <gtest/gtest.h>

#include <random>

#include "core/surface_point.h"
#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

/// Places as scenes have them, and worse: turned, stretched, mirrored, small, large, far away.
std::vector<Affine> odd_places(double room) {
  Affine sheared = placement({0.1, 0.1, 0.1}, {1, 0, 2}, 0.4, Vec3d{0.6, -0.5, 0.3} * room);
  sheared.y = sheared.y + sheared.x * 0.8;
  return {placement({0.3, 0.3, 0.3}, {0, 0, 1}, 0.0, Vec3d{0.4, 0, 0.3} * room),
          placement({0.1, 0.4, 0.2}, {1, 2, 3}, 1.0, Vec3d{-0.4, 0.3, 0.5} * room),
          placement({-0.2, 0.2, 0.2}, {3, -1, 1}, 2.0, Vec3d{0.5, 0.5, 1.4} * room),
          placement({-0.2, -0.1, -0.3}, {0, 1, 0}, 0.7, Vec3d{-0.5, 0.3, 1.4} * room),
          placement({0.01, 0.01, 0.01}, {0, 1, 1}, 3.0, Vec3d{0, -0.7, 1.0} * room),
          sheared};
}

SceneBuilder room_with_sphere(const Material& material) {
  SceneBuilder b = lamp_room(d65(), 12);
  b.sphere({}, 1.0, 3, b.material(material));
  return b;
}

/// Rays meet an instance where they meet its triangles in the world, on the same side.
TEST(Instances, RaysHitWhatIsBaked) {
  const Scene scene = with_instances(room_with_sphere(diffuse(ConstantSpectrum{0.5})).build(), odd_places(1));
  const PreparedScene instanced(scene), world(baked(scene));
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  int on_instances = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Ray ray{{uniform(random), uniform(random), 1 + uniform(random)},
                  normalize(Vec3f{uniform(random), uniform(random), uniform(random)})};
    const Hit a = instanced.accel.intersect(ray), b = world.accel.intersect(ray);
    ASSERT_NE(a.shape, kNoHit);
    on_instances += a.instance != kNoInstance;
    const SurfacePoint p = surface_point(instanced.scene.geometry, a),
                       q = surface_point(world.scene.geometry, b);
    const float grazing = std::abs(dot(q.geometric_normal, ray.direction));
    if (grazing < 0.01f || std::abs(a.t - b.t) > 0.01f) continue;  // silhouettes: either may be missed
    EXPECT_NEAR(a.t, b.t, 2e-6f / grazing);
    EXPECT_LT(length(p.position - q.position), 1e-5f);
    EXPECT_LT(std::abs(dot(p.position - q.position, q.geometric_normal)), p.error);
    if (length(p.geometric_normal - q.geometric_normal) > 0.01f) continue;  // the neighbour's, at an edge
    EXPECT_LT(length(p.geometric_normal - q.geometric_normal), 1e-4f);
    // Interpolated before the transformation here, after it there: uneven scales tell the two apart.
    EXPECT_LT(length(p.shading_normal - q.shading_normal), 0.02f);
  }
  EXPECT_GT(on_instances, 10'000);
}

TEST(Instances, PacketsAndSingleRaysAgree) {
  const Scene scene = with_instances(room_with_sphere(diffuse(ConstantSpectrum{0.5})).build(), odd_places(1));
  const PreparedScene prepared(scene);
  RayArray rays(64);
  std::vector<std::uint32_t> slots;
  std::vector<Hit> hits(64);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (std::uint32_t i = 0; i < 64; ++i) {
    rays.set(i, {{0, 0, 1}, normalize(Vec3f{uniform(random), uniform(random), uniform(random)})});
    slots.push_back(i);
  }
  prepared.accel.intersect(rays, slots, hits);
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Hit one = prepared.accel.intersect(rays[i]);
    EXPECT_EQ(hits[i].shape, one.shape);
    EXPECT_EQ(hits[i].instance, one.instance);
    EXPECT_EQ(hits[i].triangle, one.triangle);
  }
}

}  // namespace
}  // namespace photopic
