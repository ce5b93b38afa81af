#include <gtest/gtest.h>

#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

/// A glass that disperses more than any real one, V_d = 5: mistakes show.
Material strong_prism(float roughness) {
  Material m = solid_glass(1.6f, roughness);
  m.extensions.dispersion = abbe_index(1.6, 4.0);
  return m;
}

SceneBuilder dispersive_room(float roughness, const Spectrum& lamp) {
  SceneBuilder b = lamp_room(lamp, 12);
  b.sphere({-0.4, 0.1, 0.6}, 0.45, 2, b.material(strong_prism(roughness)));
  b.box({0.2, -0.2, 0.2}, {0.7, 0.3, 0.9}, b.material(strong_prism(roughness)));
  return b.turn({0, 0, 1}, 0.3);
}

RenderResult render_with(const PreparedScene& scene, const WavelengthSampler& sampler, int spp,
                         std::uint32_t seed, bool naive = false, int max_depth = 10) {
  const RenderOptions options{
      .spp = spp, .sequence = Sequence::independent, .seed = seed, .max_depth = max_depth};
  RenderResult r = naive ? render_naive(scene, sampler, options) : render(scene, sampler, options);
  EXPECT_EQ(r.stats.non_finite, 0u);
  return r;
}

/// Four wavelengths that split, under any sampler, agree with one wavelength a path, which has nothing to
/// split.
TEST(Dispersion, SplitPathsAgreeWithOneWavelengthAPath) {
  for (float roughness : {0.0f, 0.15f, 0.5f}) {
    const PreparedScene scene(dispersive_room(roughness, fl11()).build());
    const Film single =
        render_with(scene, IlluminantWavelengths{1, base_density(scene_emission(scene))}, 1200, 1).film;
    std::uint32_t seed = 2;
    for (const WavelengthSampler& sampler : all_samplers(scene_emission(scene))) {
      const std::string what =
          "roughness " + std::to_string(roughness) + ", sampler " + std::to_string(seed - 1);
      expect_same_image(render_with(scene, sampler, 500, seed).film, single, 12, what);
      ++seed;
    }
  }
}

TEST(Dispersion, AgreesWithTheOracle) {
  for (float roughness : {0.0f, 0.3f}) {
    const PreparedScene scene(dispersive_room(roughness, d65()).build());
    expect_same_image(render_with(scene, UniformWavelengths{4}, 400, 1).film,
                      render_with(scene, UniformWavelengths{4}, 800, 2, true).film, 2,
                      std::to_string(roughness));
  }
}

/// Only refraction through smooth dispersive glass splits, and a path once.
TEST(Dispersion, SplitsOnlyWhereItMust) {
  const UniformWavelengths sampler{4};
  const auto split = [&](SceneBuilder b, const WavelengthSampler& s) {
    const RenderStats stats = render_with(PreparedScene(b.build()), s, 16, 1).stats;
    EXPECT_LE(stats.split_paths, stats.paths);
    return stats.split_paths;
  };
  EXPECT_GT(split(dispersive_room(0.0f, d65()), sampler), 100u);
  EXPECT_EQ(split(dispersive_room(0.3f, d65()), sampler), 0u);
  EXPECT_EQ(split(dispersive_room(0.0f, d65()), UniformWavelengths{1}), 0u);
  EXPECT_EQ(split(glass_room(12), sampler), 0u);

  SceneBuilder pane = lamp_room(d65(), 12);
  Material thin = strong_prism(0.0f);
  thin.thin_walled = true;
  pane.box({-0.7, 0.1, 0.1}, {0.2, 0.5, 1.1}, pane.material(thin));
  EXPECT_EQ(split(pane, sampler), 0u);
}

/// A glass sphere that bends red and blue light alike by formula is the glass of a constant index.
TEST(Dispersion, OfAConstantIndexIsPlainGlass) {
  for (float roughness : {0.0f, 0.3f}) {
    const auto room = [&](bool by_formula) {
      SceneBuilder b = lamp_room(d65(), 12);
      Material m = solid_glass(1.6f, roughness);
      if (by_formula) m.extensions.dispersion = CauchyIndex{1.6, 1e-9};
      b.sphere({0, 0, 0.6}, 0.5, 2, b.material(m));
      return PreparedScene(b.build());
    };
    expect_same_image(render_with(room(true), UniformWavelengths{4}, 400, 1).film,
                      render_with(room(false), UniformWavelengths{4}, 400, 2).film, 2,
                      std::to_string(roughness));
  }
}

/// A prism's least deviation: sin((A + δ)/2) = n sin(A/2). A camera looks through a 60° prism of F2 along the
/// path of least deviation of one wavelength, at a strip of lamp that is as wide as 1.5 nm: only light near
/// that wavelength arrives, so the colour's dominant wavelength is known.
TEST(Dispersion, PrismShowsTheWavelengthOfLeastDeviation) {
  const auto n_of = [](double lambda) { return refractive_index(glass_index("F2").value(), lambda); };
  for (double lambda : {480.0, 550.0, 620.0}) {
    const double half_apex = kPi / 6, n = n_of(lambda), incidence = std::asin(n * std::sin(half_apex));
    const double deviation = 2 * incidence - 2 * half_apex;
    SceneBuilder b;
    Material flint = solid_glass(1.62f, 0.0f);
    flint.extensions.dispersion = glass_index("F2");
    const auto glass = b.material(flint);
    // The prism stands along y; symmetric about x = 0, apex up.
    const double h = std::cos(half_apex), w = std::sin(half_apex);
    const Vec3d a{-w, -1, 0}, c{w, -1, 0}, top{0, -1, h}, back{0, 2, 0};
    b.quad(a, top, top + back, a + back, glass);
    b.quad(top, c, c + back, top + back, glass);
    b.quad(c, a, a + back, c + back, glass);
    b.triangle(a, c, top, glass);
    b.triangle(a + back, top + back, c + back, glass);
    // The ray inside runs level; outside it falls by δ/2 on either side.
    const double slope = std::tan(deviation / 2), height = 0.5 * h, side = 0.5 * w;
    const Vec3d eye{-side - 2.0, 0, height - 2.0 * slope}, seen{-side, 0, height};
    const double distance = 40.0, change = (n_of(lambda - 1) - n_of(lambda + 1)) / 2;
    // dδ/dn = 2 sin(A/2)/cos(incidence): the strip's half-width.
    const double strip = distance * change * 2 * std::sin(half_apex) / std::cos(incidence) * 0.75;
    const Vec3d centre{side + distance, 0, height - distance * slope}, up{0, 0, strip}, wide{0, 2, 0};
    const auto lamp = b.lamp(ConstantSpectrum{1.0}, 100.0, true);
    b.quad(centre - up - wide, centre + up - wide, centre + up + wide, centre - up + wide, lamp);
    b.camera(eye, seen, 1e-4, 2, 2);
    // Depth 3: light that circles in the prism leaves it undispersed.
    const Film film = render_with(PreparedScene(b.build()), UniformWavelengths{4}, 20000, 1, false, 3).film;
    const std::vector<Estimate> xyz = image_estimates(film);
    const double sum = xyz[0].mean + xyz[1].mean + xyz[2].mean;
    const Xyz expected = Observer::cie1931()(lambda);
    const double expected_sum = expected.x + expected.y + expected.z;
    ASSERT_GT(sum, 0.0) << lambda;
    EXPECT_NEAR(xyz[0].mean / sum, expected.x / expected_sum, 0.02) << lambda;
    EXPECT_NEAR(xyz[1].mean / sum, expected.y / expected_sum, 0.02) << lambda;
  }
}

}  // namespace
}  // namespace photopic
