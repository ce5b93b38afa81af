#include "core/prepared_scene.h"

#include <gtest/gtest.h>

#include "support/layered_materials.h"

namespace photopic {
namespace {

using namespace test;

/// Tables take a second and more: a surface by itself integrates none, a scene those of what it shows.
TEST(PreparedScene, IntegratesTheTablesOfWhatIsUsed) {
  SceneBuilder b;
  const auto used = b.material(solid_glass(1.5f, 0.3f)), unused = b.material(solid_glass(1.5f, 0.3f)),
             brushed_used = b.material(brushed(metal(ConstantSpectrum{1.0}, 0.3f), 0.5f)),
             brushed_unused = b.material(brushed(metal(ConstantSpectrum{1.0}, 0.3f), 0.5f));
  b.sphere({0, 0, 1}, 0.5, 1, used);
  b.floor({0, 0, 0}, 1, 1, brushed_used);
  b.camera({0, -2, 1}, {0, 0, 1}, 40, 4, 4);
  const PreparedScene scene(b.build());
  EXPECT_TRUE(scene.surfaces[used].glass_albedo);
  EXPECT_FALSE(scene.surfaces[unused].glass_albedo);
  EXPECT_TRUE(scene.surfaces[brushed_used].grain_albedo);
  EXPECT_FALSE(scene.surfaces[brushed_unused].grain_albedo);
  EXPECT_FALSE(Surface(scene.scene.materials[used]).glass_albedo);
  EXPECT_FALSE(Surface(scene.scene.materials[brushed_used]).grain_albedo);
}

}  // namespace
}  // namespace photopic
