#include "core/lights/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/sampling.h"
#include "support/one_light.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

float random(std::uint32_t seed, std::uint32_t i) {
  return SampleStream(Sequence::independent, seed, 0, i).get_1d(0);
}

Vec3f random_point(std::uint32_t seed, std::uint32_t i) {
  return {random(seed, 3 * i) * 4 - 2, random(seed, 3 * i + 1) * 4 - 2, random(seed, 3 * i + 2) * 4 - 2};
}

/// Small surfaces, spots and points strewn over a room; two of them at one place.
std::vector<LightBounds> strewn(std::uint32_t count) {
  std::vector<LightBounds> lights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3f p = random_point(1, i == 1 ? 0 : i), axis = normalize(random_point(2, i));
    LightBounds b{.low = p, .high = p + Vec3f{0.1f, 0.05f, 0.0f}, .axis = axis};
    b.intensity = 0.001f + random(3, i);
    b.two_sided = i % 5 == 0;
    if (i % 7 == 0) b.cos_o = -1.0f, b.cos_e = -1.0f, b.high = p;  // a point
    if (i % 7 == 1) b.cos_e = 0.8f, b.high = p;                    // a spot
    lights.push_back(b);
  }
  return lights;
}

TEST(LightTree, ProbabilitiesSumToOneAtMost) {
  for (std::uint32_t count : {1u, 2u, 3u, 50u, 1000u}) {
    const LightTree tree = tree_of(strewn(count));
    for (std::uint32_t k = 0; k < 40; ++k) {
      const LightReference at{random_point(9, k), k % 2 ? normalize(random_point(10, k)) : Vec3f{}};
      double total = 0.0;
      for (std::uint32_t i = 0; i < count; ++i) total += tree.probability(at, i);
      // Less where a branch turns out to hold nothing that shines there: half the strewn lights look away.
      EXPECT_LT(total, 1.0 + 1e-4) << count;
      if (count >= 50 && k % 2 == 0) {
        EXPECT_GT(total, 0.3) << count;
      }
    }
  }
}

TEST(LightTree, ChoicesFollowTheProbabilities) {
  constexpr std::uint32_t kLights = 200, kSamples = 100000;
  const LightTree tree = tree_of(strewn(kLights));
  for (std::uint32_t k = 0; k < 6; ++k) {
    const LightReference at{random_point(9, k), k % 2 ? normalize(random_point(10, k)) : Vec3f{}};
    std::vector<double> observed(kLights + 1), expected;
    double total = 0.0;
    for (std::uint32_t i = 0; i < kLights; ++i) {
      expected.push_back(kSamples * double{tree.probability(at, i)});
      total += expected.back();
    }
    expected.push_back(std::max(kSamples - total, 1e-9));
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const auto choice = choose_one(tree, at, SampleStream(Sequence::independent, 4, k, i).get_1d_fine(0));
      if (choice.light != kNoLight) {
        EXPECT_NEAR(choice.probability, tree.probability(at, choice.light),
                    1e-5f * choice.probability + 1e-9f);
      }
      ++observed[choice.light == kNoLight ? kLights : choice.light];
    }
    EXPECT_GT(chi_square_p_value(observed, expected), 1e-3) << k;
  }
}

/// A wall of lamps, from close by and from so far that its patches are chosen from by intensity alone.
TEST(LightTree, PatchesSeenAlike) {
  constexpr std::uint32_t kSide = 30, kLights = kSide * kSide, kSamples = 200000;
  std::vector<LightBounds> lights;
  std::vector<std::uint32_t> names;
  for (std::uint32_t i = 0; i < kLights; ++i) {
    const Vec3f p{0.1f * static_cast<float>(i % kSide), 0.1f * static_cast<float>(i / kSide), 0.0f};
    lights.push_back({.low = p, .high = p + Vec3f{0.1f, 0.1f, 0.0f}, .axis = {0, 0, 1}});
    lights.back().intensity = 0.01f + random(3, i);
    names.push_back(5 + 3 * i);
  }
  const LightTree tree(lights, names);
  for (const float height : {0.2f, 3.0f, 30.0f}) {
    const LightReference at{{1.0f, 2.0f, height}, {0, 0, -1}};
    std::vector<double> observed(kLights), expected;
    for (std::uint32_t i = 0; i < kLights; ++i) expected.push_back(kSamples * tree.probability(at, i));
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const auto choice = choose_one(tree, at, SampleStream(Sequence::independent, 4, 0, i).get_1d_fine(0));
      const std::uint32_t light = (choice.light - 5) / 3;
      ASSERT_LT(light, kLights);
      ASSERT_NEAR(choice.probability, tree.probability(at, light), 1e-5f * choice.probability);
      ++observed[light];
    }
    EXPECT_GT(chi_square_p_value(observed, expected), 1e-3) << height;
  }
}

/// Sixteen at once are what each is alone, and lanes that are not wanted are left as they are.
TEST(LightTree, LanesDoNotMix) {
  const LightTree tree = tree_of(strewn(3000));
  for (std::uint32_t k = 0; k < 100; ++k) {
    BasicLightReference<Lanes> at{};
    DoubleLanes u{};
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      const std::uint32_t j = kLanes * k + i;
      set_lane(at.position, static_cast<int>(i), random_point(9, j));
      if (j % 3) set_lane(at.normal, static_cast<int>(i), normalize(random_point(10, j)));
      u[i] = random(11, j);
      if (random(12, j) < 0.6f) wanted.push_back(i);
    }
    LightTree::Choices choices;
    choices.fill({123456, -1.0f});
    tree.choose(at, u, wanted, choices);
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      const auto lane_i = static_cast<int>(i);
      LightTree::Choice one{123456, -1.0f};
      if (std::ranges::count(wanted, i))
        one = choose_one(tree, {lane(at.position, lane_i), lane(at.normal, lane_i)}, u[i]);
      EXPECT_EQ(choices[i].light, one.light);
      EXPECT_EQ(choices[i].probability, one.probability);
    }
  }
}

/// A light that shines on a surface is never left out: its share is at least a little.
TEST(LightTree, LightsThatReachAreChosen) {
  const std::vector<LightBounds> lights = strewn(300);
  const LightTree tree = tree_of(lights);
  for (std::uint32_t k = 0; k < 100; ++k) {
    const LightReference at{random_point(9, k), normalize(random_point(10, k))};
    for (std::uint32_t i = 0; i < 300; ++i) {
      const Vec3f to_light = lights[i].middle() - at.position, w = normalize(to_light);
      const float cos_light = -dot(lights[i].axis, w);
      const bool lit = lights[i].cos_o == -1.0f || cos_light > lights[i].cos_e + 0.01f ||
                       (lights[i].two_sided && -cos_light > lights[i].cos_e + 0.01f);
      if (lit && dot(at.normal, w) > 0.01f) {
        EXPECT_GT(tree.probability(at, i), 0.0f) << k << " " << i;
      }
    }
  }
}

/// Nor close in front of it, where its branch is seen from the side: pairs of spots that shine downwards.
TEST(LightTree, SpotsReachWhatIsCloseToThem) {
  std::vector<LightBounds> lights;
  for (int i = 0; i < 32; ++i) {
    const Vec3f pair{50.0f * static_cast<float>(i / 8), 0, 50.0f * static_cast<float>(i / 2 % 4)};
    const Vec3f p = pair + Vec3f{0.819f, 0.574f, 0} * (i % 2 ? 1.0f : -1.0f);
    lights.push_back(
        {.low = p, .high = p, .axis = {0, -1, 0}, .cos_o = 1.0f, .cos_e = 0.707f, .intensity = 1.0f});
  }
  const LightTree tree = tree_of(lights);
  for (std::uint32_t i = 0; i < 32; ++i)
    for (const float x : {-0.057f, 0.0f, 0.057f})
      for (const float z : {-0.05f, 0.0f, 0.05f})
        EXPECT_GT(tree.probability({lights[i].low + Vec3f{x, -0.082f, z}, {}}, i), 0.0f) << i;
}

/// Near lights win over strong ones far away, and those that look away lose.
TEST(LightTree, NearAndFacingLightsAreFavoured) {
  std::vector<LightBounds> lights;
  for (int i = 0; i < 100; ++i) {
    const Vec3f p{static_cast<float>(i), 0, 2};
    lights.push_back({.low = p, .high = p, .axis = {0, 0, i % 2 ? 1.0f : -1.0f}, .intensity = 1.0f});
  }
  const LightTree tree = tree_of(lights);
  const LightReference at{{20.0f, 0, 0}, {0, 0, 1}};
  EXPECT_GT(tree.probability(at, 20), 0.2f);
  EXPECT_EQ(tree.probability(at, 21), 0.0f);
  EXPECT_LT(tree.probability(at, 90), 0.01f);
}

TEST(LightTree, ManyLightsAtOnePlace) {
  std::vector<LightBounds> lights(1000,
                                  {.axis = {0, 0, 1}, .cos_o = -1.0f, .cos_e = -1.0f, .intensity = 0.5f});
  const LightTree tree = tree_of(lights);
  EXPECT_NEAR(tree.probability({{1, 2, 3}, {}}, 77), 1e-3f, 1e-6f);
  EXPECT_NEAR(tree.probability({{0, 0, 0}, {}}, 77), 1e-3f, 1e-6f);  // even from inside
}

/// Powers and sizes from the least to the largest: no probability is lost to overflow, but what falls to no
/// light.
TEST(LightTree, ExtremePowersAndSizes) {
  for (float scale : {1e-4f, 1.0f, 1e6f})
    for (float power : {1e-30f, 1.0f, 1e36f}) {
      std::vector<LightBounds> lights = strewn(100);
      for (LightBounds& b : lights) {
        b.low = b.low * scale, b.high = b.high * scale;
        b.intensity *= power;
      }
      const LightTree tree = tree_of(lights);
      for (std::uint32_t k = 0; k < 20; ++k) {
        double total = 0.0;
        for (std::uint32_t i = 0; i < 100; ++i) total += tree.probability({lights[k].low, {}}, i);
        constexpr int kChoices = 4096;
        for (int j = 0; j < kChoices; ++j) {
          const auto choice = choose_one(tree, {lights[k].low, {}}, (j + 0.5) / kChoices);
          if (choice.light == kNoLight) {
            total += 1.0 / kChoices;
            continue;
          }
          ASSERT_LT(choice.light, 100u);
          EXPECT_TRUE(choice.probability > 0.0f && choice.probability <= 1.0f) << choice.probability;
        }
        EXPECT_NEAR(total, 1.0, 0.01) << scale << " " << power;
      }
    }
}

/// Numbers at the ends of [0, 1) choose lights that shine.
TEST(LightTree, EndsOfTheUnitInterval) {
  std::vector<LightBounds> lights;
  for (int i = 0; i < 40; ++i) {
    const Vec3f p{static_cast<float>(i), 0, 2};
    lights.push_back(
        {.low = p, .high = p, .axis = {0, 0, i > 4 && i < 35 ? -1.0f : 1.0f}, .intensity = 1.0f});
  }
  const LightTree tree = tree_of(lights);
  for (double u : {0.0, 0x1p-33, 0.5, 1.0 - 0x1p-33, 1.0 - 0x1p-53}) {
    const auto choice = choose_one(tree, {{20, 0, 0}, {0, 0, 1}}, u);
    ASSERT_NE(choice.light, kNoLight) << u;
    EXPECT_TRUE(choice.light > 4 && choice.light < 35) << u;
    EXPECT_GT(choice.probability, 0.0f) << u;
  }
}

/// The union of two cones holds both.
TEST(LightTree, UnionsHoldBoth) {
  for (std::uint32_t k = 0; k < 500; ++k) {
    const LightBounds a{
        .axis = normalize(random_point(20, k)), .cos_o = random(21, k) * 2 - 1, .intensity = 1};
    const LightBounds b{
        .axis = normalize(random_point(22, k)), .cos_o = random(23, k) * 2 - 1, .intensity = 1};
    const LightBounds both = unite(a, b);
    const double angle = std::acos(both.cos_o);
    for (const LightBounds& part : {a, b}) {
      const double between = std::acos(std::clamp(dot(part.axis, both.axis), -1.0f, 1.0f));
      EXPECT_LE(std::min(between + std::acos(part.cos_o), 3.14159), angle + 2e-3) << k;
    }
  }
}

}  // namespace
}  // namespace photopic
