#include "core/lights/sky_views.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "core/scene.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

/// As bright all around: 4 lx on each half of the sphere, and a sun.
Scene with_sky() {
  Image picture(64, 32);
  std::ranges::fill(picture.pixels, static_cast<float>(2.0 / std::numbers::pi));
  Scene scene;
  scene.environment = std::make_shared<const Environment>(std::move(picture), 0.0);
  scene.punctual_lights = {
      {.kind = PunctualLight::Kind::directional, .direction = {0, -1, 0}, .intensity = 5.0f},
      {.kind = PunctualLight::Kind::directional, .intensity = 0.0f},
      {.kind = PunctualLight::Kind::point, .intensity = 3.0f}};
  return scene;
}

TEST(Sky, PartsAndFluxes) {
  const Scene scene = with_sky();
  const Sky sky(scene);
  ASSERT_EQ(sky.directions.size(), 1u);
  EXPECT_EQ(sky.directions[0], (Vec3f{0, 1, 0}));
  const std::vector<double> fluxes = sky.fluxes();
  ASSERT_EQ(fluxes.size(), sky.tiles() + 1);
  EXPECT_NEAR(std::accumulate(fluxes.begin(), fluxes.end() - 1, 0.0), 8.0, 1e-4);
  EXPECT_EQ(fluxes.back(), 5.0);
  EXPECT_TRUE(Sky(Scene{}).empty());
}

/// Places along x. Behind a wall at x = 0.3 only what lies in +x is seen; the sun is seen by those before it.
class ViewsPastAWall : public testing::Test {
 protected:
  ViewsPastAWall() {
    for (std::uint32_t i = 0; i < 4000; ++i) {
      const SampleStream s(Sequence::independent, 1, 0, i);
      places_.push_back({{s.get_1d(0), s.get_1d(1), s.get_1d(2)}, {}});
    }
    const Sky sky(scene_);
    views_ = SkyViews(sky, places_, [&](std::size_t i, std::span<SkyViews::Glimpse> glimpses) {
      const bool behind = places_[i].position.x > kWall;
      for (auto& [source, seen] : glimpses) {
        const bool is_sun = source == sky.tiles();
        const auto tile = static_cast<std::int32_t>(source);
        const bool right = !is_sun && tile % Environment::kTileColumns >= Environment::kTileColumns / 2;
        seen = behind ? (right ? 1.0f : 0.0f) : 1.0f;
      }
    });
  }
  const Environment& environment() const { return *scene_.environment; }

  static constexpr float kWall = 0.3f;
  const Scene scene_ = with_sky();
  std::vector<LightReference> places_;
  SkyViews views_;
};

TEST_F(ViewsPastAWall, LightIsLookedForWhereItIsSeen) {
  ASSERT_TRUE(views_.differ());
  for (const float x : {0.05f, 0.2f, 0.5f, 0.9f}) {
    const std::int32_t view = views_.view_at<float>({{x, 0.5f, 0.5f}, {}});
    int right = 0;
    constexpr std::uint32_t kSamples = 4000;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const auto way =
          views_.sample<float>(environment(), view, SampleStream(Sequence::sobol, 2, 0, i).get_2d(0));
      right += way.direction.x > 0.0f;
      EXPECT_NEAR(views_.pdf(environment(), view, way.direction), way.pdf, 2e-3f * way.pdf);
    }
    const double share = static_cast<double>(right) / kSamples;
    EXPECT_NEAR(share, x > kWall ? 0.95 : 0.5, 0.03) << x;
    const SkyViews::Light light = views_.lights()[static_cast<std::size_t>(view)];
    EXPECT_TRUE(light.any);
    EXPECT_NEAR(light.environment, x > kWall ? 4.0 : 8.0, 0.3);
    EXPECT_NEAR(light.directional, x > kWall ? 0.0 : 5.0, 0.3);
  }
}

/// Of each view the density is one of directions: its integral over the sphere is 1, and no part of the sky
/// has none.
TEST_F(ViewsPastAWall, DensitiesAddUp) {
  for (const float x : {0.1f, 0.8f}) {
    const std::int32_t view = views_.view_at<float>({{x, 0.5f, 0.5f}, {}});
    double sum = 0.0;
    constexpr int kRows = 256, kColumns = 512;
    for (int i = 0; i < kRows * kColumns; ++i) {
      const double y = 1.0 - 2.0 * (i / kColumns + 0.5) / kRows,
                   phi = 2 * std::numbers::pi * (i % kColumns + 0.5) / kColumns;
      const double r = std::sqrt(1.0 - y * y);
      const float pdf =
          views_.pdf(environment(), view, to_float(Vec3d{r * std::cos(phi), y, r * std::sin(phi)}));
      EXPECT_GT(pdf, 0.0f);
      sum += double{pdf} * 4 * std::numbers::pi / (kRows * kColumns);
    }
    EXPECT_NEAR(sum, 1.0, 0.01);
  }
}

/// Sixteen places at once, on either side of every plane.
TEST_F(ViewsPastAWall, LanesAsOneByOne) {
  for (std::size_t first = 0; first + kLanes <= places_.size(); first += kLanes) {
    BasicLightReference<Lanes> at{};
    for (int i = 0; i < kLanes; ++i)
      set_lane(at.position, i, places_[first + static_cast<std::size_t>(i)].position);
    const IntLanes views = views_.view_at(at);
    for (int i = 0; i < kLanes; ++i)
      ASSERT_EQ(views[i], views_.view_at(places_[first + static_cast<std::size_t>(i)]));
  }
}

/// Normals that many places share part them, too.
TEST(SkyViews, PlacesArePartedByNormals) {
  const Scene scene = with_sky();
  const Sky sky(scene);
  std::vector<LightReference> places;
  for (std::uint32_t i = 0; i < 1000; ++i)
    places.push_back(
        {SampleStream(Sequence::independent, 1, 0, i).get_1d(0) < 0.5f ? Vec3f{1, 2, 3} : Vec3f{3, 2, 1},
         i % 4 ? Vec3f{0, 1, 0} : Vec3f{0, -1, 0}});
  const SkyViews views(sky, places, [&](std::size_t i, std::span<SkyViews::Glimpse> glimpses) {
    for (auto& [source, seen] : glimpses)
      seen = source == sky.tiles() ? std::max(places[i].normal.y, 0.0f) : 0.5f;
  });
  ASSERT_TRUE(views.differ());
  const auto light = [&](Vec3f normal) {
    return views.lights()[static_cast<std::size_t>(views.view_at<float>({{1, 2, 3}, normal}))].directional;
  };
  EXPECT_NEAR(light({0, 1, 0}), 5.0, 0.1);
  EXPECT_LT(light({0, -1, 0}), 1.0);
}

}  // namespace
}  // namespace photopic
