#include "core/lights/light_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>

#include "core/sample_sequence.h"
#include "support/one_light.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

constexpr double kPiD = std::numbers::pi;

/// Three lamps: 1 m² of 2 cd/m², 6 m² of 1 cd/m² on both sides, 0.5 m² of 8 cd/m²; powers 2 : 12 : 4.
SceneBuilder three_lamps(bool one_spectrum) {
  SceneBuilder b;
  Material lamps[3];
  const int spectrum = b.emission(d65());
  const float luminances[3] = {2, 1, 8};
  for (int i = 0; i < 3; ++i) {
    lamps[i] = diffuse(ConstantSpectrum{0.0});
    lamps[i].emission_spectrum = one_spectrum || i != 1 ? spectrum : b.emission(fl11());
    lamps[i].emission_luminance = luminances[i];
    lamps[i].double_sided = i == 1;
  }
  b.floor({0, 0, 0}, 0.5, 0.5, b.material(lamps[0]));
  b.floor({0, 0, 1}, 1.5, 1.0, b.material(lamps[1]));
  b.ceiling({0, 0, 2}, 0.25, 0.5, b.material(lamps[2]));
  b.floor({0, 0, 3}, 1, 1, b.material(diffuse(ConstantSpectrum{0.5})));
  return b;
}

/// Seen from kPlace, points of equal intensity 1 m and 3 m away: the first adds nine times as much.
constexpr Vec3f kPlace{0.3f, 0.2f, 1.5f};
Scene two_points(bool one_spectrum) {
  Scene scene = three_lamps(false).build();
  for (Material& m : scene.materials) m.emission_luminance = 0.0f;
  for (const float distance : {1.0f, 3.0f})
    scene.punctual_lights.push_back({.position = kPlace + Vec3f{distance, 0, 0},
                                     .intensity = 2.0f,
                                     .emission_spectrum = one_spectrum || distance == 1.0f ? 0 : 1});
  return scene;
}

/// @return how often the first of two points was chosen in 100,000 samples
double first_chosen(const LightSampler& lights, std::span<const float> spectra) {
  double count = 0;
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const SampleStream stream(Sequence::independent, 8, 0, i);
    const auto s = sample_one(lights, {kPlace, {}}, spectra, stream.get_1d_fine(0), stream.get_2d(1));
    if (s && s->distance < 2.0f) ++count;
  }
  return count;
}

TEST(LightSampler, ChoosesByWhatMayArrive) {
  const LightSampler lights = lights_of(two_points(true));
  EXPECT_FALSE(lights.several_groups());
  const std::vector<double> expected{90'000, 10'000};
  const double first = first_chosen(lights, {});
  EXPECT_GT(chi_square_p_value(std::vector{first, 1e5 - first}, expected), 1e-3);
}

/// Spectra are chosen by brightness times what may arrive.
TEST(LightSampler, ChoosesSpectraByPlaceAndBrightness) {
  const LightSampler lights = lights_of(two_points(false));
  ASSERT_TRUE(lights.several_groups());
  const std::vector<float> spectra = group_probabilities(lights, {kPlace, {}}, {0.5f, 3.0f});
  EXPECT_NEAR(spectra[0], 4.5 / 7.5, 1e-6);
  EXPECT_NEAR(spectra[1], 3.0 / 7.5, 1e-6);
  const std::vector<double> expected{60'000, 40'000};
  const double first = first_chosen(lights, spectra);
  EXPECT_GT(chi_square_p_value(std::vector{first, 1e5 - first}, expected), 1e-3);
}

/// What lies beyond the scene and what lies within keep their shares of the choices everywhere, and all
/// shares add up.
TEST(LightSampler, SharesOfGroupsAddUp) {
  for (const float illuminance : {1e-3f, 0.3f, 1e4f}) {
    Scene scene = two_points(false);
    scene.punctual_lights.push_back(
        {.kind = PunctualLight::Kind::directional, .intensity = illuminance, .emission_spectrum = 1});
    const LightSampler lights = lights_of(scene, 4.0);
    ASSERT_EQ(lights.group_count(), 3u);
    for (std::uint32_t k = 0; k < 100; ++k) {
      const SampleStream place(Sequence::independent, 3, 0, k);
      const Vec3f at = Vec3f{place.get_1d(0), place.get_1d(1), place.get_1d(2)} * 10.0f - Vec3f{5, 5, 5};
      const auto shares = lights.group_shares({broadcast<Lanes>(at), {}});
      EXPECT_NEAR(shares[0][0] + shares[1][0] + shares[2][0], 1.0f, 1e-6f);
      EXPECT_GE(shares[2][0], 0.0999f);
      EXPECT_LE(shares[2][0], 0.9001f);
    }
  }
}

/// A sun that no place has seen is looked for all the same: nothing else finds it.
TEST(LightSampler, WhatWasNotSeenOfTheSkyIsStillChosen) {
  for (const bool with_environment : {false, true}) {
    Scene scene = two_points(false);
    scene.punctual_lights.push_back(
        {.kind = PunctualLight::Kind::directional, .intensity = 1e5f, .emission_spectrum = 1});
    if (with_environment) {
      Image picture(8, 4);
      std::ranges::fill(picture.pixels, 1.0f);
      auto environment = std::make_shared<Environment>(std::move(picture), 0.0);
      environment->emission_spectrum = 0;
      scene.environment = environment;
    }
    const std::vector<LightReference> places(100);
    const Sky sky(scene);
    for (const bool sees_tiles : {false, true}) {
      const auto survey = [&](std::size_t, std::span<SkyViews::Glimpse> glimpses) {
        for (auto& [source, seen] : glimpses) seen = sees_tiles && source < sky.tiles() ? 1.0f : 0.0f;
      };
      const std::vector<Surface> surfaces(scene.materials.begin(), scene.materials.end());
      const LightSampler lights(scene, 4.0, surfaces, SkyViews(sky, places, survey));
      const std::vector<float> shares =
          group_probabilities(lights, {kPlace, {}}, std::vector<float>(lights.group_count(), 1.0f));
      // The groups: two points, the sun, the environment.
      EXPECT_GT(shares[2], 0.004f) << with_environment << sees_tiles;
      EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0f), 1.0f, 1e-5f);
      if (!sees_tiles) {
        EXPECT_GT(shares[0] + shares[1], 0.98f);
      }
    }
  }
}

TEST(LightSampler, DarkSpectraAndThoseThatAreNoNumbers) {
  const LightSampler lights = lights_of(two_points(false));
  const std::vector<float> dark = group_probabilities(lights, {kPlace, {}}, {0.0f, 0.0f});
  EXPECT_EQ(dark, (std::vector<float>{0.0f, 0.0f}));
  EXPECT_FALSE(sample_one(lights, {kPlace, {}}, dark, 0.3, {0.5f, 0.5f}));
  const std::vector<float> odd =
      group_probabilities(lights, {kPlace, {}}, {std::numeric_limits<float>::quiet_NaN(), 1.0f});
  EXPECT_NEAR(odd[0], 0.9, 1e-6);
  EXPECT_NEAR(odd[1], 0.1, 1e-6);
}

/// A scene of 200 small lamps of some spectra and a few large ones: chosen by trees.
SceneBuilder many_lamps(int spectra) {
  SceneBuilder b = three_lamps(false);
  for (int k = 2; k < spectra; ++k) b.emission(BlackbodySpectrum{2000.0 + 500.0 * k});
  Material lamp = diffuse(ConstantSpectrum{0.0});
  for (int i = 0; i < 200; ++i) {
    lamp.emission_spectrum = i % spectra;
    lamp.emission_luminance = 1.0f + static_cast<float>(i % 13);
    const Vec3d p{0.37 * (i % 20) - 3.5, 0.41 * (i / 20) - 2.0, i % 3 ? 2.5 : -0.5};
    if (i % 3)
      b.ceiling(p, 0.05, 0.04, b.material(lamp));
    else
      b.floor(p, 0.05, 0.04, b.material(lamp));
  }
  return b;
}

/// Spots whose cone ends without a rim, many enough for the tree: on average they light a place as much as
/// they do together.
TEST(LightSampler, SpotsWithHardEdges) {
  SceneBuilder b = three_lamps(true);
  Scene scene = b.build();
  for (Material& m : scene.materials) m.emission_luminance = 0.0f;
  for (int i = 0; i < 64; ++i) {
    const float x = static_cast<float>(i % 8) - 3.5f, y = static_cast<float>(i / 8) - 3.5f;
    const float cosine = std::cos(0.1f + 0.01f * static_cast<float>(i));
    scene.punctual_lights.push_back({.kind = PunctualLight::Kind::spot,
                                     .position = {x, y, 3},
                                     .direction = normalize(Vec3f{0.3f * y, -0.2f * x, -1}),
                                     .cos_inner = cosine,
                                     .cos_outer = cosine,
                                     .intensity = 1.0f,
                                     .emission_spectrum = 0});
  }
  const LightSampler lights = lights_of(scene);
  for (std::uint32_t k = 0; k < 200; ++k) {
    const SampleStream place(Sequence::independent, 3, 0, k);
    const Vec3f at{place.get_1d(0) * 8 - 4, place.get_1d(1) * 8 - 4, place.get_1d(2) * 2.9f};
    double together = 0.0, estimate = 0.0;
    for (const PunctualLight& light : scene.punctual_lights)
      if (const auto s = light.sample(at)) together += double{s->radiance};
    constexpr int kSamples = 4096;
    for (int i = 0; i < kSamples; ++i)
      if (const auto s = sample_one(lights, {at, {}}, {}, (i + 0.5) / kSamples, {}))
        estimate += double{s->radiance} / double{s->pdf} / kSamples;
    EXPECT_NEAR(estimate, together, 0.02 * together) << k;
  }
}

/// Flux and root mean square against sums over the cosine.
TEST(PunctualLight, MomentsOfSpots) {
  for (const auto& [inner, outer] : {std::pair{0.0f, 0.4f}, {0.3f, 0.31f}, {0.7f, 1.5f}, {0.05f, 0.06f}}) {
    const PunctualLight spot{.kind = PunctualLight::Kind::spot,
                             .cos_inner = std::cos(inner),
                             .cos_outer = std::cos(outer),
                             .intensity = 7.0f};
    double flux = 0.0, square = 0.0;
    constexpr int kSteps = 100'000;
    const double step = (1.0 - double{spot.cos_outer}) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const double value = 7.0 * double{spot.attenuation(static_cast<float>(1.0 - (i + 0.5) * step))};
      flux += 2.0 * std::numbers::pi * value * step;
      square += 0.5 * value * value * step;
    }
    EXPECT_NEAR(spot.power(0.0) / flux, 1.0, 1e-3) << inner;
    EXPECT_NEAR(spot.rms_intensity() / std::sqrt(square), 1.0, 1e-3) << inner;
  }
}

/// Lights on a ring about the place that they shine on, all of one intensity: a narrow spot among points is
/// chosen by its root mean square, of which its beam has more than of its flux.
TEST(LightSampler, NarrowSpotsCountWithinTheirBeams) {
  Scene scene = three_lamps(true).build();
  for (Material& m : scene.materials) m.emission_luminance = 0.0f;
  constexpr int kLights = 64, kSpot = 17;
  for (int i = 0; i < kLights; ++i) {
    const float angle = 2.0f * kPi * static_cast<float>(i) / kLights;
    const Vec3f to_middle{-std::cos(angle), -std::sin(angle), 0.0f};
    scene.punctual_lights.push_back(
        {.kind = i == kSpot ? PunctualLight::Kind::spot : PunctualLight::Kind::point,
         .position = -to_middle,
         .direction = to_middle,
         .cos_inner = std::cos(0.05f),
         .cos_outer = std::cos(0.06f),
         .intensity = 3.0f,
         .emission_spectrum = 0});
  }
  const LightSampler lights = lights_of(scene);
  constexpr int kSamples = 1 << 14;
  int spots = 0;
  for (int i = 0; i < kSamples; ++i) {
    const auto s = sample_one(lights, {{}, {}}, {}, (i + 0.5) / kSamples, {});
    if (s && s->end == scene.punctual_lights[kSpot].position) ++spots;
  }
  const PunctualLight& spot = scene.punctual_lights[kSpot];
  const double expected = spot.rms_intensity() / double{spot.intensity};
  EXPECT_GT(expected, 10.0 * spot.power(0.0) / scene.punctual_lights[0].power(0.0));
  EXPECT_NEAR(spots * kLights / double{kSamples} / expected, 1.0, 0.3);
}

/// Of two spectra, where one is chosen first.
std::vector<float> some_probabilities(const LightSampler& lights, const LightReference& at) {
  if (!lights.several_groups()) return {};
  return group_probabilities(lights, at, {0.7f, 0.2f});
}

/// Of a few kinds of light one is chosen first; of more there is one tree.
TEST(LightSampler, ManyKindsStandInOneTree) {
  EXPECT_EQ(lights_of(many_lamps(4).build()).group_count(), 4u);
  EXPECT_EQ(lights_of(many_lamps(5).build()).group_count(), 1u);
}

/// The density that a sample has is the one that is found for a ray which hits its point.
TEST(LightSampler, DensitiesAreFoundAgain) {
  for (const SceneBuilder& b : {three_lamps(false), many_lamps(2), many_lamps(7)}) {
    const Scene scene = b.build();
    const LightSampler lights = lights_of(scene);
    for (std::uint32_t k = 0; k < 50; ++k) {
      const SampleStream place(Sequence::independent, 3, 0, k);
      const LightReference at{{place.get_1d(0) * 2 - 1, place.get_1d(1) * 2 - 1, place.get_1d(2) * 2},
                              {0, 0, k % 2 ? 1.0f : 0.0f}};
      const std::vector<float> spectra = some_probabilities(lights, at);
      for (std::uint32_t i = 0; i < 100; ++i) {
        const SampleStream stream(Sequence::independent, 8, k, i);
        const auto s = sample_one(lights, at, spectra, stream.get_1d_fine(0), stream.get_2d(1));
        if (!s) continue;
        EXPECT_NEAR(lights.pdf(at, spectra, s->triangle / 2, s->triangle, s->distance), s->pdf,
                    1e-3f * s->pdf);
      }
    }
  }
}

/// Over the directions in which a triangle's glowing side is seen; by area, n² points.
double integrate_density(const LightSampler& lights, const Scene& scene, const LightReference& at,
                         std::span<const float> spectra, std::uint32_t triangle, int n) {
  const Geometry& g = scene.geometry;
  const auto& t = g.triangles[triangle];
  const Vec3f a = g.positions[t[0]], ab = g.positions[t[1]] - a, ac = g.positions[t[2]] - a;
  const Vec3f normal = cross(ab, ac);  // twice the area long
  const std::uint32_t shape = triangle / 2;
  const bool both_sides = scene.materials[g.shapes[shape].material].double_sided;
  double sum = 0.0;
  for (int i = 0; i < n * n; ++i) {
    // Unfolded squares: each cell has as much of the triangle.
    const float x = (static_cast<float>(i % n) + 0.5f) / static_cast<float>(n),
                y = (static_cast<float>(i / n) + 0.5f) / static_cast<float>(n);
    const Vec3f way = a + ab * (1.0f - std::sqrt(x)) + ac * (y * std::sqrt(x)) - at.position;
    const float distance = length(way), cosine = -dot(way, normal) / distance;
    if (cosine <= 0.0f && !both_sides) continue;
    sum += double{lights.pdf(at, spectra, shape, triangle, distance)} * double{0.5f * std::abs(cosine)} /
           double{distance * distance};
  }
  return sum / (n * n);
}

/// The densities' integral over all directions is the share of samples that are given.
TEST(LightSampler, DensitiesAddUpToOne) {
  for (const SceneBuilder& b : {three_lamps(false), many_lamps(2), many_lamps(7)}) {
    const Scene scene = b.build();
    const LightSampler lights = lights_of(scene);
    for (std::uint32_t k = 0; k < 8; ++k) {
      const SampleStream place(Sequence::independent, 3, 0, k);
      const LightReference at{
          {place.get_1d(0) * 2 - 1, place.get_1d(1) * 2 - 1, 1.2f + 0.6f * place.get_1d(2)},
          {0, 0, k % 2 ? 1.0f : 0.0f}};
      const std::vector<float> spectra = some_probabilities(lights, at);
      double sum = 0.0;
      for (std::uint32_t t = 0; t < scene.geometry.triangles.size(); ++t)
        if (scene.materials[scene.geometry.shapes[t / 2].material].emission_spectrum >= 0)
          sum += integrate_density(lights, scene, at, spectra, t, t < 6 ? 256 : 8);
      constexpr int kSamples = 20000;
      int given = 0;
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        const SampleStream stream(Sequence::independent, 8, k, i);
        given += sample_one(lights, at, spectra, (i + 0.5) / kSamples, stream.get_2d(1)).has_value();
      }
      EXPECT_NEAR(sum, static_cast<double>(given) / kSamples, 0.01) << k;
    }
  }
}

/// A lamp that fills a sixth of the sphere, a point, a spot, a directional light and an environment that is
/// the same all around: each is chosen by what may arrive of it, with the density that it is to have.
TEST(LightSampler, EveryKindFollowsItsDensity) {
  SceneBuilder b;
  b.ceiling({0, 0, 2}, 0.5, 0.5, b.lamp(d65(), 8.0));
  Scene scene = b.build();
  using Kind = PunctualLight::Kind;
  const Vec3f point{1, 0, 1}, spot{0, 1, 3};
  scene.punctual_lights = {
      {.kind = Kind::point, .position = point, .intensity = 1.0f},
      {.kind = Kind::spot, .position = spot, .cos_inner = 0.5f, .cos_outer = 0.5f, .intensity = 6.0f},
      {.kind = Kind::directional, .intensity = 3.0f}};
  for (PunctualLight& light : scene.punctual_lights) light.emission_spectrum = 0;
  Image picture(1, 2);
  for (int y = 0; y < 2; ++y) std::fill_n(picture.at(0, y), 3, static_cast<float>(2.0 / (4.0 * kPiD)));
  auto environment = std::make_shared<Environment>(std::move(picture), 0.0);
  environment->emission_spectrum = 0;
  scene.environment = environment;
  const LightSampler lights = lights_of(scene, 2.0);

  const LightReference at{{0, 0, 1.5f}, {}};
  // Root mean square intensities over squared distances, that of the lamp being its radius; all are seen from
  // within their beams. Of the sky, what is seen on average by surfaces that are turned anyhow.
  const double lamp = 8 / std::sqrt(6.0) / 0.5, near = 1 / 1.25, wide = 6 * std::sqrt(0.25) / 3.25;
  const double sun = 3.0 * std::sqrt(1.0 / 3), sky = 2.0 * std::sqrt(1.0 / 3);
  const double total = lamp + near + wide + sun + sky;
  const double chosen[] = {lamp / total, near / total, wide / total, sun / total, sky / total};
  const double pdf[] = {chosen[0] / (4 * kPiD / 6), chosen[1], chosen[2], chosen[3], chosen[4] / (4 * kPiD)};
  const std::vector<float> groups = group_probabilities(lights, at, {1, 1, 1});
  const auto kind_of = [&](const LightSample& s) -> std::size_t {
    if (s.environment) return 4;
    if (!s.delta) return 0;
    if (std::isinf(s.distance)) return 3;
    return s.end == spot ? 2 : 1;
  };
  constexpr std::uint32_t kPackets = 5000;
  std::vector<double> observed(5), expected;
  for (const double p : chosen) expected.push_back(kPackets * kLanes * p);
  for (std::uint32_t k = 0; k < kPackets; ++k) {
    LightReferenceLanes packet{
        .place = {broadcast<Lanes>(at.position), {}}, .groups = {}, .u_choice = {}, .u = {}, .count = kLanes};
    packet.groups.fill(groups);
    for (int i = 0; i < kLanes; ++i) {
      const SampleStream stream(Sequence::independent, 8, k, static_cast<std::uint32_t>(i));
      const Sample2d u = stream.get_2d(1);
      packet.u_choice[i] = stream.get_1d_fine(0), packet.u.x[i] = u.x, packet.u.y[i] = u.y;
    }
    LightSampleLanes samples;
    lights.sample(packet, samples);
    for (int i = 0; i < kLanes; ++i) {
      const auto s = lane_of(samples, i);
      ASSERT_TRUE(s);
      const std::size_t kind = kind_of(*s);
      ++observed[kind];
      ASSERT_NEAR(s->pdf, pdf[kind], 1e-4 * pdf[kind]) << kind;
      if (kind == 0) {
        ASSERT_NEAR(lights.pdf(at, groups, 0, s->triangle, s->distance), s->pdf, 1e-4f * s->pdf);
      }
      if (kind == 4) {
        ASSERT_NEAR(lights.environment_pdf(at, groups, s->direction), s->pdf, 1e-4f * s->pdf);
      }
    }
  }
  EXPECT_GT(chi_square_p_value(observed, expected), 1e-3);
}

TEST(LightSampler, PowerOfSpectra) {
  SceneBuilder b = three_lamps(false);
  Scene scene = b.build();
  using Kind = PunctualLight::Kind;
  scene.punctual_lights = {{.kind = Kind::point, .intensity = 3.0f, .emission_spectrum = 0},
                           {.kind = Kind::directional, .intensity = 0.5f, .emission_spectrum = 1}};
  const LightSampler lights = lights_of(scene, 2.0);
  ASSERT_EQ(lights.power_of_spectrum().size(), 2u);
  EXPECT_NEAR(lights.power_of_spectrum()[0], kPiD * 6.0 + 4 * kPiD * 3.0, 1e-4);
  EXPECT_NEAR(lights.power_of_spectrum()[1], kPiD * 12.0 + kPiD * 4.0 * 0.5, 1e-4);
}

TEST(LightSampler, DarkAndDegenerateLampsAreNotChosen) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 1, 1, b.lamp(d65(), 0.0));
  b.triangle({0, 0, 1}, {1, 0, 1}, {2, 0, 1}, b.lamp(d65(), 5.0));
  EXPECT_TRUE(lights_of(b.build()).empty());
  b.floor({0, 0, 2}, 1, 1, b.lamp(d65(), 1e-6));
  const LightSampler lights = lights_of(b.build());
  ASSERT_FALSE(lights.empty());
  EXPECT_FALSE(lights.several_groups());
  for (double u : {0.0, 0.5, 1.0 - 0x1p-32}) {
    const auto s = sample_one(lights, {{0, 0, 3}, {}}, {}, u, {0.3f, 0.6f});
    ASSERT_TRUE(s);
    EXPECT_GE(s->triangle, 3u);
  }
}

}  // namespace
}  // namespace photopic
