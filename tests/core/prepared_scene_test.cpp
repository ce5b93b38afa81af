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

}  // namespace
}  // namespace photopic
