#include "core/prepared_scene.h"

#include <gtest/gtest.h>

#include "support/layered_materials.h"

namespace photopic {
namespace {

using namespace test;

/// Tables take a second and more: a surface by itself integrates none, a scene those of what it shows.
TEST(PreparedScene, IntegratesTheTablesOfWhatIsUsed) {
  SceneBuilder b;
  const auto used = b.material(solid_glass(1.5f, 0.3f)), unused = b.material(solid_glass(1.5f, 0.3f));
  b.sphere({0, 0, 1}, 0.5, 1, used);
  b.camera({0, -2, 1}, {0, 0, 1}, 40, 4, 4);
  const PreparedScene scene(b.build());
  EXPECT_TRUE(scene.surfaces[used].glass_albedo);
  EXPECT_FALSE(scene.surfaces[unused].glass_albedo);
  EXPECT_FALSE(Surface(scene.scene.materials[used]).glass_albedo);
}

/// Of rough glass what needs the same table shares one. What has no other glass at its place has one ratio,
/// that to air, whatever else the scene holds.
TEST(PreparedScene, RoughGlassesShareTables) {
  const auto tables_of = [](double apart, std::initializer_list<float> indices) {
    SceneBuilder b;
    double x = 0.0;
    for (const float ior : indices)
      b.sphere({x, 0, 0}, 0.5, 1, b.material(solid_glass(ior, 0.3f))), x += apart;
    b.camera({0, -2, 1}, {0, 0, 1}, 40, 4, 4);
    const PreparedScene scene(b.build());
    std::vector<std::shared_ptr<const GlassAlbedo>> tables;
    for (const Surface& s : scene.surfaces) tables.push_back(s.glass_albedo);
    return tables;
  };
  const auto alone = tables_of(2.0, {1.5f, 1.8f, 1.5f});
  ASSERT_TRUE(alone[0] && alone[1]);
  EXPECT_EQ(alone[0], alone[2]);
  EXPECT_NE(alone[0], alone[1]);
  // Where one may be in the other, tables hold their ratio, too: 1.2 is no longer that nearest to it, 1.5.
  const auto nested = tables_of(0.1, {1.5f, 1.8f});
  const auto missing = [](const GlassAlbedo& table) { return table.average_missing(0.3f, 1.2f, {}); };
  const float own = missing(GlassAlbedo({1.2f}, {0.3f, 0.3f}));
  EXPECT_NEAR(missing(*nested[0]), own, 0.02f * own);
  EXPECT_EQ(missing(*alone[0]), alone[0]->average_missing(0.3f, 1.5f, {}));
  EXPECT_NE(missing(*alone[0]), missing(*nested[0]));
}

}  // namespace
}  // namespace photopic
