#include <gtest/gtest.h>

#include "core/image_metrics.h"
#include "integrator/integrator.h"
#include "integrator/tile.h"
#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

/// Two films that are a known ΔE apart: grey of L* 60 and 50, of which ΔE2000 depends on the mean L* alone.
TEST(TileError, IsHalfTheDistanceOfTheFilms) {
  const auto grey = [](double l) { return d65_white() * std::pow((l + 16.0) / 116.0, 3); };
  Film a(20, 4), b(20, 4);
  for (std::size_t i = 0; i < 80; ++i) {
    a.add(i, grey(60));
    b.add(i, grey(i % 20 < 16 ? 50 : 60));
  }
  const double s = 1.0 + 0.015 * 25.0 / std::sqrt(20.0 + 25.0);  // S_L of CIEDE2000 at a mean L* of 55
  const std::vector<Tile> tiles = film_tiles({0, 0, 20, 4});
  ASSERT_EQ(tiles.size(), 2u);
  EXPECT_NEAR(expected_delta_e(a, b, tiles[0], d65_white()).value(), 0.5 * 10.0 / s, 1e-9);
  EXPECT_NEAR(expected_delta_e(a, b, tiles[1], d65_white()).value(), 0.0, 1e-9);

  // Of 3 samples to 1 the distance is 2/√3 times as large, and the mean of all nearer to the three.
  for (std::size_t i = 0; i < 80; ++i) a.add(i, grey(60)), a.add(i, grey(60));
  EXPECT_NEAR(expected_delta_e(a, b, tiles[0], d65_white()).value(), std::sqrt(3.0) / 4.0 * 10.0 / s, 1e-9);
  EXPECT_NEAR(expected_delta_e(a, b, tiles, d65_white()).value(), 0.8 * std::sqrt(3.0) / 4.0 * 10.0 / s,
              1e-9);
}

TEST(TileError, IsNotKnownOfOneFilm) {
  Film a(20, 4), b(20, 4);
  const std::vector<Tile> tiles = film_tiles({0, 0, 20, 4});
  for (std::size_t i = 0; i < 80; ++i) a.add(i, d65_white());
  EXPECT_FALSE(expected_delta_e(a, b, tiles[0], d65_white()));
  b.add(0, d65_white());  // a pixel that lost its samples does not count
  EXPECT_EQ(expected_delta_e(a, b, tiles[0], d65_white()).value(), 0.0);
  EXPECT_FALSE(expected_delta_e(a, b, tiles, d65_white()));
}

/// Against a reference of many samples: the error reached is the one asked for, by its own estimate and in
/// truth; dark and bright tiles take what each needs; the mean stays unbiased.
TEST(Limits, TargetErrorIsReachedAndTheMeanUnbiased) {
  const PreparedScene scene(glossy_room(24).build());
  const WavelengthSampler sampler = all_samplers(scene_emission(scene)).at(2);
  const RenderResult reference = render(scene, sampler, {.spp = 4096, .seed = 99});
  double previous = 1e9;
  for (double target : {4.0, 1.5}) {
    const RenderResult r = render(scene, sampler, {.spp = 2048, .target_error = target, .seed = 3});
    ASSERT_TRUE(r.stats.expected_delta_e);
    EXPECT_LE(*r.stats.expected_delta_e, target);
    EXPECT_FALSE(r.stats.stopped);
    const double truth =
        compare_images(reference.film.to_linear_srgb(), r.film.to_linear_srgb()).mean_delta_e;
    EXPECT_LT(truth, 1.1 * target);
    EXPECT_GT(truth, 0.4 * target) << "many more samples than needed";
    EXPECT_LT(truth, previous);
    previous = truth;
    EXPECT_LT(r.stats.paths, 24u * 24u * 2048u);
    EXPECT_LT(std::abs(z_score(luminance(r.film), luminance(reference.film))), 4.5);
  }
}

TEST(Limits, TargetErrorNeverTakesMoreThanSpp) {
  const PreparedScene scene(diffuse_room(20).build());
  const RenderResult r = render(scene, UniformWavelengths{4}, {.spp = 37, .target_error = 1e-3});
  EXPECT_EQ(r.stats.paths, 20u * 20u * 37u);
  EXPECT_GT(*r.stats.expected_delta_e, 1e-3);
}

/// However the samples fall to the two films, the estimate is near the truth; of one film there is none.
TEST(Limits, ExpectedErrorIsTheTrueOne) {
  const PreparedScene scene(glossy_room(24).build());
  const WavelengthSampler sampler = all_samplers(scene_emission(scene)).at(2);
  const Image reference = render(scene, sampler, {.spp = 4096, .seed = 99}).film.to_linear_srgb();
  for (int spp : {9, 16, 24, 37}) {
    const RenderResult r = render(scene, sampler, {.spp = spp, .target_error = 1e-3, .seed = 3});
    const double truth = compare_images(reference, r.film.to_linear_srgb()).mean_delta_e;
    ASSERT_TRUE(r.stats.expected_delta_e) << spp;
    EXPECT_NEAR(*r.stats.expected_delta_e, truth, 0.3 * truth) << spp;
  }
  EXPECT_FALSE(render(scene, sampler, {.spp = 8, .target_error = 1e-3}).stats.expected_delta_e);
  const RenderOptions hasty{.spp = 1 << 20, .seconds = 1e-6, .target_error = 1e-3};
  EXPECT_FALSE(render(scene, sampler, hasty).stats.expected_delta_e);
}

TEST(Limits, TimeLeavesNoPixelWithoutASample) {
  const PreparedScene scene(diffuse_room(40).build());
  const RenderResult least = render(scene, UniformWavelengths{4}, {.spp = 1 << 20, .seconds = 1e-6});
  EXPECT_EQ(least.stats.paths, 40u * 40u);
  EXPECT_FALSE(least.stats.stopped);
  const RenderResult more = render(scene, UniformWavelengths{4}, {.spp = 1 << 20, .seconds = 0.5});
  EXPECT_GE(more.stats.seconds, 0.5);
  EXPECT_GT(more.stats.paths, 40u * 40u);
  // What was taken in time has the bits of the same samples taken at leisure.
  const RenderResult one = render(scene, UniformWavelengths{4}, {.spp = 1});
  for (std::size_t i = 0; i < 1600; ++i) EXPECT_EQ(one.film.mean(i).y, least.film.mean(i).y);
}

}  // namespace
}  // namespace photopic
