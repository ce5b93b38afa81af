#include "integrator/first_hits.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numbers>

#include "integrator/integrator.h"
#include "support/standard_scenes.h"

namespace photopic {
namespace {

using namespace test;

/// So many samples in each pixel.
Film counted(const Scene& scene, int samples) {
  Film film(scene.camera.width, scene.camera.height);
  for (std::size_t i = 0; i < static_cast<std::size_t>(film.width() * film.height()); ++i)
    for (int s = 0; s < samples; ++s) film.add(i, {});
  return film;
}

FirstHits hits_of(const PreparedScene& scene, int samples, bool hurry = false) {
  const std::atomic<bool> in_hurry = hurry;
  return first_hits(scene, counted(scene.scene, samples), Sequence::sobol, 3, in_hurry);
}

void expect_near(const float* seen, Vec3d expected, double tolerance) {
  EXPECT_NEAR(seen[0], expected.x, tolerance);
  EXPECT_NEAR(seen[1], expected.y, tolerance);
  EXPECT_NEAR(seen[2], expected.z, tolerance);
}

/// A plane across the view has one depth, whatever the angle of the rays; its normal looks at the viewer from
/// either side.
TEST(FirstHits, PlaneAcrossTheView) {
  for (const double side : {1.0, -1.0}) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 10, 10, b.material(diffuse(upsample_reflectance({0.5, 0.3, 0.2}))));
    b.camera({0.2, 0.1, side * 2.5}, {0.2, 0.1, 0}, 60, 5, 4);
    const FirstHits hits = hits_of(PreparedScene(b.build()), 8);
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_NEAR(hits.depth[i], 2.5, 1e-5);
      expect_near(&hits.normal.pixels[3 * i], {0, 0, side}, 1e-6);
      expect_near(&hits.albedo.pixels[3 * i], {0.5, 0.3, 0.2}, 1e-3);
    }
  }
}

/// Seen at an angle, the plane z = 0 has at film height y the depth h / (sin a + y cos a): closed form at the
/// pixel's middle, to the variation over a narrow pixel.
TEST(FirstHits, TiltedPlane) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 100, 100, b.material(diffuse(ConstantSpectrum{0.25})));
  b.camera({0, 0, 1}, {0, std::numbers::sqrt3, 0}, 20, 64, 64);
  const FirstHits hits = hits_of(PreparedScene(b.build()), 64);
  const double pixel = 2.0 * std::tan(std::numbers::pi / 18) / 64;
  for (int y = 0; y < 64; ++y) {
    const double up = (31.5 - y) * pixel;
    const double depth = 1.0 / (0.5 - up * 0.5 * std::numbers::sqrt3);
    const auto i = static_cast<std::size_t>(64 * y + 7);
    EXPECT_NEAR(hits.depth[i], depth, 2e-4 * depth) << y;
    expect_near(&hits.normal.pixels[3 * i], {0, 0, 1}, 1e-6);
    EXPECT_EQ(hits.albedo.pixels[3 * i], 0.25f);
  }
}

/// Half a pixel of surface: half the albedo and normal, the whole depth; beside it nothing.
TEST(FirstHits, AnEdgeAndNothing) {
  SceneBuilder b;
  const auto grey = b.material(diffuse(ConstantSpectrum{0.8}));
  b.quad({-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}, grey);
  b.camera({0, 0, 1}, {0, 0, 0}, 40, 3, 3);
  const FirstHits hits = hits_of(PreparedScene(b.build()), 64);
  EXPECT_NEAR(hits.albedo.at(1, 1)[0], 0.4, 1e-6);  // Sobol' points: 32 of 64 in either half
  expect_near(hits.normal.at(1, 1), {0, 0, 0.5}, 1e-6);
  EXPECT_NEAR(hits.depth[4], 1.0, 1e-6);
  EXPECT_EQ(hits.alpha[4], 0.5f);
  const int empty = hits.depth[3] == 0.0f ? 0 : 2;
  expect_near(hits.albedo.at(empty, 1), {}, 0.0);
  expect_near(hits.normal.at(empty, 1), {}, 0.0);
  EXPECT_EQ(hits.depth[static_cast<std::size_t>(3 + empty)], 0.0f);
  EXPECT_NEAR(hits.depth[static_cast<std::size_t>(3 + 2 - empty)], 1.0, 1e-6);
}

/// Glass and mirrors are surfaces like others.
TEST(FirstHits, GlassAndMetal) {
  const std::pair<Material, double> cases[] = {{solid_glass(1.5f, 0.0f), 1.0},
                                               {metal(ConstantSpectrum{0.6}, 0.0f), 0.6}};
  for (const auto& [material, albedo] : cases) {
    SceneBuilder b;
    b.sphere({0, 0, 0}, 1, 4, b.material(material));
    b.camera({0, 0, 4}, {0, 0, 0}, 1, 2, 2);
    const FirstHits hits = hits_of(PreparedScene(b.build()), 8);
    EXPECT_NEAR(hits.depth[0], 3.0, 2e-3);
    EXPECT_NEAR(hits.normal.pixels[2], 1.0, 2e-3);
    expect_near(hits.albedo.pixels.data(), {albedo, albedo, albedo}, 1e-6);
  }
}

/// Of metals by their measured index it is what a mirror of them shows of white: rendered under D65.
TEST(FirstHits, MeasuredMetal) {
  for (const char* name : {"Au", "Cu", "brass"}) {
    Material mirror = metal(ConstantSpectrum{0.0}, 0.0f);
    mirror.extensions.conductor = conductor_index(name);
    SceneBuilder b;
    b.floor({0, 0, 0}, 1, 1, b.material(mirror));
    b.ceiling({0, 0, 3}, 10, 10, b.lamp(d65(), 1.0));
    b.camera({0, 0, 1}, {0, 0, 0}, 1, 2, 2);
    const PreparedScene scene(b.build());
    const Xyz seen = render(scene, UniformWavelengths{4}, {.spp = 1 << 14}).film.image_mean();
    const Rgb color = xyz_to_linear_srgb(seen);
    const FirstHits hits = hits_of(scene, 1);
    expect_near(hits.albedo.pixels.data(), {std::min(color.r, 1.0), color.g, color.b}, 2e-3);
    EXPECT_GT(hits.albedo.pixels[0], hits.albedo.pixels[2] + 0.2f) << name;
  }
}

/// Unlit surfaces show their colour; what is more saturated than sRGB is clamped.
TEST(FirstHits, UnlitAndSaturated) {
  Material unlit = diffuse(ConstantSpectrum{0.5});
  unlit.unlit = true;
  unlit.emissive_factor = {0.2f, 0.4f, 0.6f};
  const Material laser_red = diffuse(TabulatedSpectrum({650, 651, 700, 701}, {0, 1, 1, 0}, Beyond::zero));
  const auto albedo_of = [](const Material& material) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 10, 10, b.material(material));
    b.camera({0, 0, 1}, {0, 0, 0}, 10, 1, 1);
    return hits_of(PreparedScene(b.build()), 2).albedo.pixels;
  };
  expect_near(albedo_of(unlit).data(), {0.2, 0.4, 0.6}, 1e-6);
  const auto red = albedo_of(laser_red);
  EXPECT_GT(red[0], 0.05f);
  EXPECT_EQ(red[1], 0.0f);
}

TEST(FirstHits, OneSampleInAHurry) {
  const PreparedScene scene(glass_room(12).build());
  const FirstHits hurried = hits_of(scene, 9, true), one = hits_of(scene, 1);
  EXPECT_EQ(hurried.albedo.pixels, one.albedo.pixels);
  EXPECT_EQ(hurried.depth, one.depth);
}

TEST(FirstHits, ThreadsChangeNoBit) {
  const PreparedScene scene(glass_room(20).build());
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return hits_of(scene, 5);
  };
  const FirstHits one = with(1), two = with(2);
  EXPECT_EQ(one.albedo.pixels, two.albedo.pixels);
  EXPECT_EQ(one.normal.pixels, two.normal.pixels);
  EXPECT_EQ(one.depth, two.depth);
  EXPECT_NE(one.depth, hits_of(scene, 4).depth);
}

}  // namespace
}  // namespace photopic
