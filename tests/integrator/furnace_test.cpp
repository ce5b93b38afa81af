#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "support/layered_materials.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

/// A closed box that emits 3 cd/m² from all its walls and reflects nothing; a white object in it is not seen.
SceneBuilder furnace() {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.camera({0, -1.9, 0}, {0, 0, 0}, 50, 16, 16);
  return b;
}

Estimate luminance(const SceneBuilder& b, int max_depth = 200, int spp = 64) {
  const PreparedScene scene(b.build());
  const RenderResult r = render(scene, IlluminantWavelengths{4, base_density(scene_emission(scene))},
                                {.spp = spp, .seed = 5, .max_depth = max_depth});
  EXPECT_EQ(r.stats.non_finite, 0u);
  return image_estimates(r.film)[1];
}

/// @param error the largest; beyond 0.001 the tolerance grows by four of it
void expect_unseen(const Material& material, double tolerance, const std::string& what, int spp = 2048,
                   double error = 0.001) {
  SceneBuilder boxed = furnace();
  boxed.box({-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, boxed.material(material));
  const Estimate e = luminance(boxed, 1000, spp);
  EXPECT_NEAR(e.mean, 3.0, 3.0 * tolerance + (error > 0.001 ? 4.0 * e.error : 0.0)) << what << " box";
  EXPECT_LT(e.error, error * 3.0) << what;
}

TEST(Furnace, WhiteObjectsAreNotSeen) {
  const ConstantSpectrum white{1.0};
  expect_unseen(diffuse(white), 2e-4, "diffuse", 1 << 15);  // four standard errors: 1.3e-4
  for (float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    const std::string r = std::to_string(roughness);
    expect_unseen(metal(white, roughness), 0.005, "metal " + r);
    expect_unseen(plastic(white, roughness), 0.005, "plastic " + r);
  }
  expect_unseen(solid_glass(1.5f, 0.0f), 1e-3, "glass");
  expect_unseen(solid_glass(2.4f, 0.0f), 1e-3, "diamond");
  expect_unseen(solid_glass(1.0f, 0.0f), 1e-4, "air");
  expect_unseen(thin_glass(1.5f, 0.0f), 1e-4, "thin glass");
}

/// Smooth normals on facets lose what is sent below the facet: little, and nothing is gained.
TEST(Furnace, SmoothSpheres) {
  for (const Material& m : {diffuse(ConstantSpectrum{1.0}), metal(ConstantSpectrum{1.0}, 0.3f),
                            solid_glass(1.5f, 0.0f), thin_glass(1.5f, 0.0f)}) {
    SceneBuilder b = furnace();
    b.sphere({0, 0, 0}, 0.8, 4, b.material(m));
    const Estimate e = luminance(b);
    EXPECT_LT(e.mean, 3.0 + 4.0 * e.error);
    EXPECT_GT(e.mean, 3.0 * 0.985);
  }
}

/// Rough glass gives back what one bounce off the microsurface loses: closed boxes of it are not seen,
/// however many bounces within.
TEST(Furnace, RoughGlassIsNotSeen) {
  for (float roughness : {0.1f, 0.4f, 1.0f}) {
    const std::string r = std::to_string(roughness);
    const int spp = roughness < 0.5f ? 256 : 768;
    expect_unseen(solid_glass(1.5f, roughness), 0.005, "glass " + r, spp, 0.005);
    expect_unseen(thin_glass(1.5f, roughness), 0.005, "thin glass " + r, spp, 0.005);
    Material flint = solid_glass(1.5f, roughness), filmed = flint;
    flint.extensions.dispersion = glass_index("SF11");
    expect_unseen(flint, 0.005, "SF11 " + r, spp, 0.005);
    expect_unseen(iridescent(filmed, 400.0f), 0.005, "film on glass " + r, spp, 0.005);
  }
  for (float ior : {2.4f, 3.0f, 4.0f})
    expect_unseen(solid_glass(ior, 0.1f), 0.005, "index " + std::to_string(ior), 256);
  expect_unseen(solid_glass(2.4f, 0.4f), 0.005, "rougher glass of index 2.4", 256, 0.005);
  Material flint = solid_glass(1.5f, 0.0f);
  flint.extensions.dispersion = glass_index("SF11");
  expect_unseen(flint, 1e-3, "smooth SF11");
}

/// Where every wall emits 1 and reflects ρ, the series Σ ρⁱ has max_depth terms.
TEST(Furnace, GeometricSeriesOfBounces) {
  for (double albedo : {0.5, 0.9})
    for (int depth : {1, 2, 3, 8, 100}) {
      SceneBuilder b;
      Material m = diffuse(ConstantSpectrum{albedo});
      m.emission_spectrum = b.emission(d65());
      m.emission_luminance = 1.0f;
      b.box({-1, -1, -1}, {1, 1, 1}, b.material(m), true);
      b.camera({0, 0, 0}, {1, 0.2, 0.1}, 70, 16, 16);
      const Estimate e = luminance(b, depth);
      const double expected = (1.0 - std::pow(albedo, depth)) / (1.0 - albedo);
      EXPECT_NEAR(e.mean, expected, 4.0 * e.error + 1e-4 * expected) << albedo << " depth " << depth;
      EXPECT_LT(e.error, 0.02 * expected);
    }
}

}  // namespace
}  // namespace photopic
