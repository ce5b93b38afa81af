#include "core/normal_map.h"

#include <gtest/gtest.h>

#include "support/instances.h"

namespace photopic {
namespace {

using namespace test;

MaterialTextures tilted_map() {
  auto image = std::make_shared<TextureImage>();
  image->width = image->height = 1, image->channels = 3;
  image->texels =
      std::vector<std::uint8_t>{190, 160, 230};  // towards the tangent, and somewhat the bitangent
  MaterialTextures textures;
  textures.normal.image = std::move(image);
  return textures;
}

Geometry triangle(bool with_tangents) {
  Geometry g;
  g.positions = {{-0.3f, 0, 0.1f}, {1, 0.2f, 0}, {0.1f, 1, -0.2f}};
  g.triangles = {{0, 1, 2}};
  g.shapes = {{0, 1, 0}};
  g.normals.assign(3, normalize(Vec3f{0.1f, 0.2f, 1}));
  g.uvs[0] = {{0, 0}, {0.9f, 0.1f}, {0.3f, -0.8f}};
  if (with_tangents) g.tangents.assign(3, {1, 0, 0, -1});
  return g;
}

/// A normal map on an instance bends the same way as on the triangle baked into the world, mirrored or not.
TEST(NormalMap, InstancesLikeWhatIsBaked) {
  const MaterialTextures textures = tilted_map();
  for (const bool with_tangents : {false, true}) {
    for (const Vec3d& scale : {Vec3d{1, 1, 1}, Vec3d{2, 2, -2}, Vec3d{-1, 0.5, 1.5}, Vec3d{-2, -1, -3}}) {
      const Affine m = placement(scale, {1, 2, -1}, 0.9, {3, 4, 5});
      Geometry instanced = triangle(with_tangents), world = instanced;
      instanced.prototypes = {{0, 1}};
      instanced.instances = {{round_to_float(m), 0, 1e-6f}};
      for (Vec3f& p : world.positions) p = to_float(m.point(to_double(p)));
      for (Vec3f& n : world.normals) n = to_float(normalize(m.normal(to_double(n))));
      for (Vec4f& t : world.tangents) {
        const Vec3f image = to_float(normalize(m.vector({t.x, t.y, t.z})));
        t = {image.x, image.y, image.z, m.determinant() < 0 ? -t.w : t.w};
      }
      // Mirrored triangles turn their winding, and with it the coordinates' order.
      const bool mirrored = m.determinant() < 0;
      if (mirrored) std::swap(world.triangles[0][1], world.triangles[0][2]);
      const Hit hit{.shape = 0, .triangle = 0, .instance = 0, .u = 0.2f, .v = 0.5f, .t = 1};
      Hit same = hit;
      same.instance = kNoInstance;
      if (mirrored) std::swap(same.u, same.v);

      const SurfacePoint a = surface_point(instanced, hit), b = surface_point(world, same);
      EXPECT_LT(length(a.shading_normal - b.shading_normal), 1e-5f);
      for (const auto& [geometry, met] : {std::pair(&instanced, hit), std::pair(&world, same)}) {
        EXPECT_TRUE(meets_front(*geometry, met, -a.geometric_normal));
        EXPECT_FALSE(meets_front(*geometry, met, a.geometric_normal));
      }
      const Vec3f bent = mapped_normal(instanced, hit, a, a.shading_normal, textures.normal,
                                       textures.normal_scale),
                  expected =
                      mapped_normal(world, same, b, b.shading_normal, textures.normal, textures.normal_scale);
      EXPECT_LT(length(bent - expected), 1e-5f) << with_tangents << ' ' << scale.x;
      EXPECT_GT(length(bent - a.shading_normal), 0.1f);
    }
  }
}

}  // namespace
}  // namespace photopic
