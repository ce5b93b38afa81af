#include <gtest/gtest.h>

#include <numbers>

#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

constexpr double kPiD = std::numbers::pi;

/// The floor at the world's zero, seen through a pinhole of a view.
SceneBuilder floor_scene(double albedo, Vec3d camera = {-1, 0, 1}) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{albedo})));
  b.camera(camera, {0, 0, 0}, 0.02, 8, 8);
  return b;
}

/// Lines of a hundredth of a nanometre beside daylight and beside each other: each is as bright as it should
/// be, and together they light a floor in proportion.
TEST(Lights, NarrowLines) {
  const std::vector<Spectrum> lamps{LineSpectrum{532, 0.01}, LineSpectrum{633, 0.01},
                                    LineSpectrum{436, 0.001}, d65()};
  SceneBuilder b = floor_scene(0.5);
  for (std::size_t i = 0; i < lamps.size(); ++i)
    b.ceiling({0.1 * (static_cast<double>(i) - 1.5), 0, 20}, 0.04, 0.04, b.lamp(lamps[i], 1e5));
  const PreparedScene scene(b.build());
  const TabulatedSpectrum emission = scene_emission(scene);
  double irradiance = 0.0;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const double x = 0.1 * (static_cast<double>(i) - 1.5), d2 = 400.0 + x * x;
    irradiance += 1e5 * 0.0064 * (400.0 / d2) / d2;  // L·A·cos²/d²
  }
  const RenderOptions o{.spp = 2000, .sequence = Sequence::independent, .seed = 4, .max_depth = 2};
  for (const WavelengthSampler& s : all_samplers(emission)) {
    const RenderResult r = render(scene, s, o);
    EXPECT_EQ(r.stats.non_finite, 0u) << sampler_name(s);
    if (s.index() >= 2) expect_luminance(r.film, 0.5 * irradiance / kPiD, std::string(sampler_name(s)), 1e-3);
  }
}

TEST(Lights, LineThatFillsTheView) {
  for (double width : {10.0, 0.1, 1e-3, 1e-5}) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 1, 1, b.lamp(LineSpectrum{532, width}, 6.0));
    b.camera({0, 0, 1}, {0, 0, 0}, 30, 8, 8);
    expect_luminance(render_finite(b, 1000, 1), 6.0, std::to_string(width), 1e-3);
  }
}

/// An endless lamp overhead: irradiance π·L.
TEST(Lights, Huge) {
  for (double half : {1e3, 1e5, 1e7}) {
    SceneBuilder b = floor_scene(0.5);
    b.ceiling({0, 0, 1.5}, half, half, b.lamp(d65(), 2.0));
    expect_luminance(render_finite(b, 2000, 2), 1.0, std::to_string(half), 2e-3);
  }
}

TEST(Lights, Tiny) {
  for (double half : {1e-3, 1e-5, 1e-7}) {
    SceneBuilder b = floor_scene(0.5);
    const double irradiance = 100.0, area = 4 * half * half;
    b.ceiling({0, 0, 3}, half, half, b.lamp(d65(), irradiance * 9.0 / area));
    expect_luminance(render_finite(b, 500, 2), 0.5 * irradiance / kPiD, std::to_string(half), 1e-3);
  }
}

/// Light that skims the floor is neither lost to the floor's own triangles nor doubled.
TEST(Lights, GrazingIncidence) {
  for (double elevation : {1e-1, 1e-2, 1e-3}) {
    SceneBuilder b;
    const auto paint = b.material(diffuse(ConstantSpectrum{0.5}));
    for (int x = -4; x < 4; ++x)
      for (int y = -4; y < 4; ++y) b.floor({0.25 * x + 0.1, 0.25 * y + 0.1, 0}, 0.125, 0.125, paint);
    // A small lamp at distance 5 that faces the spot.
    const double h = 5 * elevation, d2 = 25 + h * h, half = 0.2 * h;
    const Vec3d up = normalize(Vec3d{-elevation, 0, 1}) * half, side{0, half, 0}, c{5, 0, h};
    b.quad(c - up - side, c - up + side, c + up + side, c + up - side, b.lamp(d65(), 1e6, true));
    b.camera({-0.5, 0, 1}, {0, 0, 0}, 0.01, 8, 8);
    const double irradiance = 1e6 * 4 * half * half / d2 * (h / std::sqrt(d2));
    expect_luminance(render_finite(b, 500, 2), 0.5 * irradiance / kPiD, std::to_string(elevation), 3e-3);
  }
}

/// Seen at a grazing angle a Lambertian floor keeps its radiance.
TEST(Lights, GrazingView) {
  for (double elevation : {1e-1, 1e-2, 1e-3}) {
    SceneBuilder b = floor_scene(0.5, {1, 0, elevation});
    b.ceiling({0, 0, 1000}, 1, 1, b.lamp(d65(), 1e6));
    b.camera({1, 0, elevation}, {0, 0, 0}, 0.0005, 8, 8);
    expect_luminance(render_finite(b, 300, 2), 0.5 * 4.0 / kPiD, std::to_string(elevation), 1e-3);
  }
}

TEST(Lights, BrightBesideDim) {
  SceneBuilder b = floor_scene(0.5);
  b.ceiling({0, 0, 10}, 0.1, 0.1, b.lamp(d65(), 1e9));
  b.ceiling({0.5, 0, 10}, 0.1, 0.1, b.lamp(fl11(), 1e-6));
  expect_luminance(render_finite(b, 500, 2), 0.5 * 1e9 * 0.04 / 100 / kPiD, "bright", 1e-3);
}

TEST(Lights, NoLampAtAll) {
  SceneBuilder b = floor_scene(0.5);
  const PreparedScene scene(b.build());
  EXPECT_TRUE(scene.lights.empty());
  const RenderResult r = render(scene, UniformWavelengths{4}, {.spp = 4});
  EXPECT_EQ(r.film.image_mean().y, 0.0);
  EXPECT_EQ(r.stats.non_finite, 0u);
}

TEST(Lights, EmptyScene) {
  SceneBuilder b;
  b.camera({0, 0, 0}, {1, 0, 0}, 40, 4, 4);
  const RenderResult r = render(PreparedScene(b.build()), UniformWavelengths{4}, {.spp = 4});
  EXPECT_EQ(r.film.image_mean().y, 0.0);
}

}  // namespace
}  // namespace photopic
