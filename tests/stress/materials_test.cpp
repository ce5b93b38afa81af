#include <gtest/gtest.h>

#include "support/bsdf_checks.h"
#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

SceneBuilder furnace(const Material& m) {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.box({-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, b.material(m));
  b.camera({0.5, -1.9, 0.7}, {0, 0, 0}, 50, 8, 8);
  return b;
}

/// Rough glass in a furnace of 3 cd/m². @param largest_error that the estimate may have
void expect_clear(const Film& film, const std::string& what, double largest_error = 0.06) {
  const Estimate e = luminance(film);
  EXPECT_LT(e.error, largest_error) << what;
  EXPECT_NEAR(e.mean, 3.0, 4.5 * e.error + 0.02) << what;
}

/// White and clear things stay unseen in a furnace through the whole range of roughness, the change to a
/// mirror included.
TEST(Materials, RoughnessInFineSteps) {
  std::vector<float> steps{1e-6f, 1e-3f, 0.01f, 0.03f, 0.0316f, 0.0317f, 0.032f};
  for (int i = 0; i <= 40; ++i) steps.push_back(static_cast<float>(i) / 40);
  for (float roughness : steps) {
    expect_luminance(render_finite(furnace(metal(ConstantSpectrum{1.0}, roughness)), 60), 3.0,
                     "metal " + std::to_string(roughness), 0.006);
    expect_luminance(render_finite(furnace(plastic(ConstantSpectrum{1.0}, roughness)), 60), 3.0,
                     "plastic " + std::to_string(roughness), 0.006);
    for (bool thin : {false, true}) {
      const Material m = thin ? thin_glass(1.5f, roughness) : solid_glass(1.5f, roughness);
      expect_clear(render_finite(furnace(m), 100, 200),
                   (thin ? "pane " : "glass ") + std::to_string(roughness));
    }
  }
}

TEST(Materials, IndicesOfRefraction) {
  for (float ior : {1.0f, 1.0f + 1e-6f, 1.00005f, 1.0002f, 1.01f, 1.5f, 4.0f}) {
    expect_luminance(render_finite(furnace(solid_glass(ior, 0.0f)), 60, 500), 3.0,
                     "glass " + std::to_string(ior), 1e-3);
    expect_luminance(render_finite(furnace(thin_glass(ior, 0.0f)), 60, 500), 3.0,
                     "pane " + std::to_string(ior), 1e-3);
    expect_luminance(render_finite(furnace(plastic(ConstantSpectrum{1.0}, 0.5f, ior)), 60), 3.0,
                     "plastic " + std::to_string(ior), 0.006);
    for (float roughness : {0.04f, 0.2f, 1.0f}) {
      // Where the index is high, radiance grows with its square, and so does the noise.
      expect_clear(render_finite(furnace(solid_glass(ior, roughness)), 60, 200),
                   "rough glass " + std::to_string(ior) + " " + std::to_string(roughness),
                   ior > 2.0f ? 0.8 : 0.06);
    }
  }
}

/// Almost no change of index is almost no surface: what rough glass scatters tends to what passes straight
/// on.
TEST(Materials, RoughGlassTendsToAir) {
  for (float ior : {1.0001f, 1.001f, 1.01f})
    for (double cos_theta : {0.9, -0.9}) {
      const LocalBsdf glass = local_bsdf(solid_glass(ior, 0.2f));
      const Vec3f wo = direction(cos_theta);
      Vec3d mean{};
      for (std::uint32_t i = 0; i < 256; ++i) {
        const SampleStream stream(Sequence::sobol, 0, 0, i);
        const auto s = glass.sample(wo, stream.get_1d(0), stream.get_2d(1));
        if (s) mean = mean + to_double(s->wi) * (s->weight / 256);
      }
      EXPECT_LT(length(mean + to_double(wo)), 3.0 * (ior - 1.0f) + 2e-3) << ior << ' ' << cos_theta;
    }
}

/// White walls that all emit 1: every one of a thousand bounces adds 1. No path may die, grow or overflow.
TEST(Materials, ThousandBouncesInAWhiteBox) {
  SceneBuilder b;
  Material m = diffuse(ConstantSpectrum{1.0});
  m.emission_spectrum = b.emission(d65());
  m.emission_luminance = 1.0f;
  b.box({-1, -1, -1}, {1, 1, 1}, b.material(m), true);
  b.camera({0, 0, 0}, {1, 0.2, 0.1}, 70, 6, 6);
  expect_luminance(render_finite(b, 16, 1000), 1000.0, "white box", 2e-3);
}

/// A lamp in a white box of metal and glass, the limit far away: finite, and no brighter than the lamp (each
/// radiance is a mean of lamp radiances).
TEST(Materials, DeepPathsInAMirroredBox) {
  SceneBuilder b;
  b.box({-1, -1, -1}, {1, 1, 1}, b.material(metal(ConstantSpectrum{0.999}, 0.0f)), true);
  b.ceiling({0, 0, 0.9}, 0.3, 0.3, b.lamp(fl11(), 2.0));
  b.sphere({0.3, 0.2, -0.3}, 0.4, 2, b.material(solid_glass(1.5f, 0.0f)));
  b.camera({0, -0.9, 0}, {0, 0, 0}, 60, 8, 8);
  const Estimate e = luminance(render_finite(b, 100, 1000));
  EXPECT_LT(e.mean, 2.0 + 4.5 * e.error);
}

/// Extremes of what a file may say: black, strong absorption, strange mixes.
TEST(Materials, Extremes) {
  std::vector<Material> odd{metal(ConstantSpectrum{0.0}, 0.0f), plastic(ConstantSpectrum{0.0}, 1.0f),
                            plastic(ConstantSpectrum{1.0}, 0.3f, 0.0f), solid_glass(0.0f, 0.0f),
                            solid_glass(0.0f, 0.5f)};
  Material ink = solid_glass(1.5f, 0.2f);
  ink.attenuation_color = ConstantSpectrum{0.0};
  ink.attenuation_distance = 1e-6f;
  odd.push_back(ink);
  ink.attenuation_color = ConstantSpectrum{1e-30};
  ink.attenuation_distance = 1e6f;
  odd.push_back(ink);
  Material mix = solid_glass(1.5f, 0.3f);
  mix.metallic = 0.5f, mix.transmission = 0.5f, mix.specular = 0.0f;
  odd.push_back(mix);
  mix.specular_color = ConstantSpectrum{100.0};
  mix.specular = 1.0f;
  odd.push_back(mix);
  for (std::size_t i = 0; i < odd.size(); ++i) {
    const Estimate e = luminance(render_finite(furnace(odd[i]), 60, 40));
    EXPECT_LT(e.mean, 3.0 * 1.01 + 4.5 * e.error) << i;
  }
}

}  // namespace
}  // namespace photopic
