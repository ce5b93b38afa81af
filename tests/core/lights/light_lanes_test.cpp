#include <gtest/gtest.h>

#include "core/lights/light_sampler.h"
#include "core/sample_sequence.h"
#include "support/one_light.h"
#include "support/standard_scenes.h"

namespace photopic {
namespace {

using namespace test;

float random(std::uint32_t seed, std::uint32_t i) {
  return SampleStream(Sequence::independent, seed, 0, i).get_1d(0);
}

/// Squares of one spectrum facing up and down, both sides of every seventh aglow, and triangles.
SceneBuilder lamps(int count) {
  SceneBuilder b;
  const int spectrum = b.emission(d65());
  for (int i = 0; i < count; ++i) {
    Material lamp = diffuse(ConstantSpectrum{0.0});
    lamp.emission_spectrum = spectrum;
    lamp.emission_luminance = 1.0f + static_cast<float>(i % 5);
    lamp.double_sided = i % 7 == 0;
    const auto material = b.material(lamp);
    const Vec3d p{0.3 * (i % 10) - 1.5, 0.4 * (i / 10) - 2.0, i % 3 ? 2.5 : -0.5};
    const double half = i % 11 == 0 ? 0.6 : 0.04;  // some loom large
    if (i % 4 == 0)
      b.triangle(p, p + Vec3d{half, 0, 0}, p + Vec3d{0, half, 0.1}, material);
    else if (i % 3)
      b.ceiling(p, half, half, material);
    else
      b.floor(p, half, half, material);
  }
  return b;
}

Scene with_others(int count) {
  Scene scene = lamps(count).build();
  using Kind = PunctualLight::Kind;
  scene.punctual_lights = {{.kind = Kind::point, .position = {0, 0, 1}, .intensity = 9.0f},
                           {.kind = Kind::directional, .intensity = 0.5f}};
  for (PunctualLight& light : scene.punctual_lights) light.emission_spectrum = 0;
  return scene;
}

LightReferenceLanes some_points(std::uint32_t k, int count) {
  LightReferenceLanes at{.place = {}, .groups = {}, .u_choice = {}, .u = {}, .count = count};
  for (int i = 0; i < kLanes; ++i) {
    const std::uint32_t j = 16 * k + static_cast<std::uint32_t>(i);
    set_lane(at.place.position, i, {random(1, j) * 3 - 1.5f, random(2, j) * 3 - 1.5f, random(3, j) * 2});
    if (i % 3) set_lane(at.place.normal, i, {0, 0, i % 2 ? 1.0f : -1.0f});
    at.u_choice[i] = SampleStream(Sequence::independent, 4, 0, j).get_1d_fine(0);
    at.u.x[i] = random(5, j), at.u.y[i] = random(6, j);
  }
  return at;
}

void expect_same(const LightSampleLanes& lanes, int i, const std::optional<LightSample>& one) {
  ASSERT_EQ(lanes.reached[i] != 0, one.has_value());
  if (!one) return;
  EXPECT_NEAR(length(lane(lanes.direction, i) - one->direction), 0.0f, 1e-5f);
  EXPECT_NEAR(length(lane(lanes.end, i) - one->end), 0.0f, 1e-5f);
  EXPECT_NEAR(lanes.pdf[i], one->pdf, 1e-4f * one->pdf);
  EXPECT_EQ(lanes.radiance[i], one->radiance);
  EXPECT_EQ(lanes.delta[i] != 0, one->delta);
  EXPECT_EQ(lanes.spectrum[i], one->spectrum);
  EXPECT_EQ(lanes.material[i], one->material);
  EXPECT_EQ(lanes.triangle[i], one->triangle);
  if (!std::isinf(one->distance)) {
    EXPECT_NEAR(lanes.distance[i], one->distance, 1e-5f * one->distance);
  }
}

/// Sixteen at once are what each is alone, of few lights and of many, whose tree may be all there is.
TEST(LightLanes, AsOneByOne) {
  for (const Scene& scene : {with_others(3), with_others(100), lamps(100).build()}) {
    const LightSampler lights = lights_of(scene, 5.0);
    int reached = 0;
    for (std::uint32_t k = 0; k < 200; ++k) {
      const LightReferenceLanes at = some_points(k, k % 16 + 1);
      LightSampleLanes samples;
      lights.sample(at, samples);
      for (int i = 0; i < at.count; ++i) {
        const LightReference here{lane(at.place.position, i), lane(at.place.normal, i)};
        const auto one = sample_one(lights, here, {}, at.u_choice[i], lane(at.u, i));
        reached += one.has_value();
        expect_same(samples, i, one);
      }
    }
    EXPECT_GT(reached, 500);
  }
}

TEST(LightLanes, OneLampAlone) {
  for (int shape : {1, 4}) {  // a square, a triangle
    SceneBuilder b;
    const auto material = b.lamp(d65(), 4.0, true);
    if (shape == 1)
      b.ceiling({0, 0, 1}, 0.7, 0.4, material);
    else
      b.triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1.2}, material);
    const LightSampler lights = lights_of(b.build());
    for (std::uint32_t k = 0; k < 50; ++k) {
      const LightReferenceLanes at = some_points(k, kLanes);
      LightSampleLanes samples;
      ASSERT_TRUE(lights.has_only_light());
      lights.sample_only_light(at.place.position, at.u, samples);
      for (int i = 0; i < kLanes; ++i) {
        const LightReference here{lane(at.place.position, i), {}};
        expect_same(samples, i, sample_one(lights, here, {}, 0.5, lane(at.u, i)));
      }
    }
  }
  LightSampleLanes samples;
  EXPECT_FALSE(lights_of(lamps(2).build()).has_only_light());
}

}  // namespace
}  // namespace photopic
