#include <gtest/gtest.h>

#include <numbers>

#include "core/bsdf/fresnel.h"
#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

constexpr double kPiD = std::numbers::pi;

Environment constant_sky(float luminance, int spectrum) {
  Image picture(4, 2);
  std::ranges::fill(picture.pixels, luminance);
  Environment e(std::move(picture), 0.0);
  e.emission_spectrum = spectrum;
  return e;
}

/// A floor of albedo 0.5 at zero, z up, seen through a pinhole.
SceneBuilder floor_scene(double albedo = 0.5) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{albedo})));
  b.camera({-1, 0, 1}, {0, 0, 0}, 0.02, 8, 8);
  return b;
}

double floor_luminance(double illuminance) {
  return 0.5 * illuminance / kPiD;
}

/// E = I cos θ / d².
TEST(PunctualLights, Point) {
  SceneBuilder b = floor_scene();
  const int spectrum = b.emission(fl11());
  Scene scene = b.build();
  scene.punctual_lights = {{.position = {3, 0, 4}, .intensity = 200.0f, .emission_spectrum = spectrum}};
  expect_luminance(render_finite(PreparedScene(scene), 500, 2), floor_luminance(200.0 / 25.0 * 0.8), "point");
}

/// On the axis full, in the middle of the rim a quarter (a square law), outside nothing.
TEST(PunctualLights, Spot) {
  for (const auto& [cosine, share] : {std::pair{0.95f, 1.0}, {0.8f, 0.25}, {0.65f, 0.0}}) {
    SceneBuilder b = floor_scene();
    const int spectrum = b.emission(d65());
    Scene scene = b.build();
    const float sine = std::sqrt(1 - cosine * cosine);
    scene.punctual_lights = {{.kind = PunctualLight::Kind::spot,
                              .position = {0, 0, 2},
                              .direction = {sine, 0, -cosine},
                              .cos_inner = 0.9f,
                              .cos_outer = 0.7f,
                              .intensity = 50.0f,
                              .emission_spectrum = spectrum}};
    const Film film = render_finite(PreparedScene(scene), 200, 2);
    if (share > 0.0)
      expect_luminance(film, floor_luminance(share * 50.0 / 4.0), std::to_string(cosine), 2e-3);
    else
      EXPECT_EQ(film.image_mean().y, 0.0);
  }
}

/// A spot's flux: the intensity summed over directions.
TEST(PunctualLights, Power) {
  for (const auto& [inner, outer] : {std::pair{0.9f, 0.5f}, {0.99f, 0.98f}, {0.7f, 0.7f}, {1.0f, 0.0f}}) {
    const PunctualLight spot{
        .kind = PunctualLight::Kind::spot, .cos_inner = inner, .cos_outer = outer, .intensity = 3};
    double flux = 0.0;
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i)
      flux += 2 * kPiD * 3 * spot.attenuation(static_cast<float>(-1 + 2 * (i + 0.5) / kSteps)) * 2 / kSteps;
    EXPECT_NEAR(spot.power(1.0), flux, 1e-3 * flux) << inner << " " << outer;
  }
}

TEST(PunctualLights, DirectionalAndShadow) {
  for (bool shaded : {false, true}) {
    SceneBuilder b = floor_scene();
    const int spectrum = b.emission(BlackbodySpectrum{5000});
    if (shaded) b.floor({0, 0, 1.5}, 0.2, 0.2, b.material(diffuse(ConstantSpectrum{0.0})));
    Scene scene = b.build();
    scene.punctual_lights = {{.kind = PunctualLight::Kind::directional,
                              .direction = {0, 0, -1},
                              .intensity = 4.0f,
                              .emission_spectrum = spectrum}};
    const Film film = render_finite(PreparedScene(scene), 500, 2);
    if (!shaded)
      expect_luminance(film, floor_luminance(4.0), "directional");
    else
      EXPECT_EQ(film.image_mean().y, 0.0);
  }
}

/// Panes of thin glass over the floor, under a light without extent in the direction w: what arrives of it.
double share_through(const std::vector<Material>& panes, Vec3f w, bool at_a_point = false) {
  SceneBuilder b = floor_scene();
  for (std::size_t i = 0; i < panes.size(); ++i)
    b.floor({0, 0, 0.2 + 0.1 * static_cast<double>(i)}, 0.5, 0.5, b.material(panes[i]));
  b.camera({-1.5, 0, 0.1}, {0, 0, 0}, 0.01, 8, 8);  // below them
  const int spectrum = b.emission(fl11());
  Scene scene = b.build();
  if (at_a_point)
    scene.punctual_lights = {{.position = w * 3.0f, .intensity = 9.0f, .emission_spectrum = spectrum}};
  else
    scene.punctual_lights = {{.kind = PunctualLight::Kind::directional,
                              .direction = -w,
                              .intensity = 1.0f,
                              .emission_spectrum = spectrum}};
  RenderOptions direct{.spp = 1000, .max_depth = 2};
  const PreparedScene prepared(scene);
  const RenderResult result =
      render(prepared, IlluminantWavelengths{4, base_density(scene_emission(prepared))}, direct);
  EXPECT_EQ(result.stats.non_finite, 0u);
  return result.film.image_mean().y / floor_luminance(w.z);
}

/// BSDF sampling never finds such a light through glass that only lets pass straight on; shadow rays do.
TEST(PunctualLights, ShineThroughThinPanes) {
  const auto passed = [](float cosine) {
    const float f = fresnel_dielectric(cosine, 1.5f);
    return 1.0 - 2.0 * f / (1.0 + f);
  };
  const Vec3f up{0, 0, 1}, slanted{0.6f, 0, 0.8f};
  const Material pane = thin_glass(1.5f, 0.0f);
  EXPECT_NEAR(share_through({}, up), 1.0, 2e-3);
  EXPECT_NEAR(share_through({pane}, up), passed(1.0f), 2e-3);
  EXPECT_NEAR(share_through({pane}, up, true), passed(1.0f), 2e-3);
  EXPECT_NEAR(share_through({pane, pane, pane}, slanted), std::pow(passed(0.8f), 3), 2e-3);
  Material tinted = pane;
  tinted.base_color = ConstantSpectrum{0.5}, tinted.transmission = 0.8f;
  EXPECT_NEAR(share_through({tinted}, up), 0.5 * 0.8 * passed(1.0f), 2e-3);

  EXPECT_EQ(share_through({pane, diffuse(ConstantSpectrum{0.5})}, up), 0.0);
  EXPECT_EQ(share_through({solid_glass(1.5f, 0.0f)}, up), 0.0);
  EXPECT_EQ(share_through({pane, thin_glass(0.0f, 0.0f)}, up), 0.0);  // a mirror
}

/// Lamps of every kind light one spot in the sum of their parts, whichever are chosen.
TEST(PunctualLights, AllKindsTogether) {
  SceneBuilder b = floor_scene();
  b.ceiling({0, 0, 10}, 0.1, 0.1, b.lamp(fl11(), 3e4));
  const int warm = b.emission(BlackbodySpectrum{2700}), day = b.emission(d65());
  Scene scene = b.build();
  using Kind = PunctualLight::Kind;
  scene.punctual_lights = {{.position = {0, 3, 4}, .intensity = 100.0f, .emission_spectrum = warm},
                           {.kind = Kind::directional,
                            .direction = {0.6f, 0, -0.8f},
                            .intensity = 2.0f,
                            .emission_spectrum = day}};
  for (int i = 0; i < 60; ++i)  // enough for the tree
    scene.punctual_lights.push_back(
        {.position = {0.01f * static_cast<float>(i), 0, 5}, .intensity = 1.0f, .emission_spectrum = warm});
  scene.environment = std::make_shared<const Environment>(constant_sky(0.7f, day));
  double illuminance = 3e4 * 0.04 / 100 + 100.0 / 25 * 0.8 + 2.0 * 0.8 + kPiD * 0.7;
  for (int i = 0; i < 60; ++i) {
    const double d2 = 25 + 1e-4 * i * i;
    illuminance += 5 / (d2 * std::sqrt(d2));
  }
  expect_luminance(render_finite(PreparedScene(scene), 8000, 2), floor_luminance(illuminance), "all", 1e-3);
}

/// Under a sky of one luminance nothing that is white is seen, and the floor has albedo × L.
TEST(EnvironmentLight, Furnace) {
  for (const Material& m : {diffuse(ConstantSpectrum{1.0}), metal(ConstantSpectrum{1.0}, 0.0f),
                            solid_glass(1.5f, 0.0f), thin_glass(1.5f, 0.0f)}) {
    SceneBuilder b;
    b.box({-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, b.material(m));
    b.camera({0, -3, 0.5}, {0, 0, 0}, 40, 16, 16);
    const int spectrum = b.emission(ConstantSpectrum{1.0});
    Scene scene = b.build();
    scene.environment = std::make_shared<const Environment>(constant_sky(3.0f, spectrum));
    const Estimate e = luminance(render_finite(PreparedScene(scene), 200, 200));
    EXPECT_NEAR(e.mean, 3.0, 2e-3 + 4 * e.error);
    EXPECT_LT(e.error, 0.02);
  }
}

/// A floor in a black box, under a hole of 0.2 × 0.2 m in its ceiling 1 m above. @param lamp_luminance of a
/// lamp beside the hole [cd/m²] @param glazed whether a pane lies on it, of index 1: as if it were none
Scene floor_under_a_hole(double lamp_luminance, bool glazed) {
  SceneBuilder b;
  const auto grey = b.material(diffuse(ConstantSpectrum{0.5})),
             black = b.material(diffuse(ConstantSpectrum{0.0}));
  b.floor({0, 0, 0}, 2, 2, grey);
  for (const double side : {-1.0, 1.0}) {
    b.ceiling({1.05 * side, 0, 1}, 0.95, 2, black);
    b.ceiling({0, 1.05 * side, 1}, 0.1, 0.95, black);
    b.quad({2 * side, -2, 0}, {2 * side, 2, 0}, {2 * side, 2, 1}, {2 * side, -2, 1}, black);
    b.quad({-2, 2 * side, 0}, {2, 2 * side, 0}, {2, 2 * side, 1}, {-2, 2 * side, 1}, black);
  }
  b.ceiling({0.3, 0, 0.99}, 0.1, 0.1, b.lamp(d65(), lamp_luminance));
  if (glazed) b.ceiling({0, 0, 1.05}, 0.3, 0.3, b.material(thin_glass(1.0f, 0.0f)));
  b.camera({0, 0, 0.9}, {0, 0, 0}, 2, 4, 4);
  return b.build();
}

/// ∫ cos θ dω over a square that lies parallel to the floor, 1 m above: contour integral of a polygon
/// (Arvo 1995, equation 2.10).
double square_overhead(double x0, double x1, double y0, double y1) {
  const Vec3d corner[] = {{x0, y0, 1}, {x1, y0, 1}, {x1, y1, 1}, {x0, y1, 1}};
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Vec3d a = normalize(corner[i]), b = normalize(corner[(i + 1) % 4]), n = normalize(cross(a, b));
    sum += 0.5 * std::acos(dot(a, b)) * n.z;
  }
  return std::abs(sum);
}

/// Sky through a small hole, or window, is found as surely as a lamp is.
TEST(EnvironmentLight, IsLookedForWhereItIsSeen) {
  const double hole = square_overhead(-0.1, 0.1, -0.1, 0.1), lamp = square_overhead(0.2, 0.4, -0.1, 0.1);
  for (const auto& [lamp_luminance, glazed] :
       {std::pair{0.0, false}, {0.0, true}, {5.0, false}, {5.0, true}}) {
    Scene scene = floor_under_a_hole(lamp_luminance, glazed);
    scene.environment = std::make_shared<const Environment>(constant_sky(3.0f, 0));
    // Looking everywhere would leave an error of 0.1.
    expect_luminance(render_finite(PreparedScene(scene), 4000, 3),
                     0.5 / kPiD * (3.0 * hole + lamp_luminance * lamp), "hole", 1e-3);
  }
}

/// Every pixel of a coloured picture, seen directly, reads its own linear sRGB, whatever the samples.
TEST(EnvironmentLight, ColoursAreKept) {
  for (const Rgb& rgb : {Rgb{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {4, 4, 4}, {0.2, 0.5, 0.9}, {30, 20, 1}}) {
    Image picture(2, 1);
    for (int x = 0; x < 2; ++x) {
      float* p = picture.at(x, 0);
      p[0] = static_cast<float>(rgb.r), p[1] = static_cast<float>(rgb.g), p[2] = static_cast<float>(rgb.b);
    }
    SceneBuilder b;
    b.camera({0, 0, 0}, {1, 0, 0}, 40, 4, 4);
    const int spectrum = b.emission(d65());
    Scene scene = b.build();
    Environment e(std::move(picture), 0.0);
    e.emission_spectrum = spectrum;
    scene.environment = std::make_shared<const Environment>(std::move(e));
    const std::vector<Estimate> seen = image_estimates(render_finite(PreparedScene(scene), 4000, 1));
    const Xyz xyz = linear_srgb_to_xyz(rgb);
    const double expected[] = {xyz.x, xyz.y, xyz.z}, top = std::max({rgb.r, rgb.g, rgb.b});
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(seen[i].mean, expected[i], 4.5 * seen[i].error + 2e-3 * top);
  }
}

/// The clever sampler against the oracle: an uneven sky with a bright patch over a room with a hole, lamps of
/// other spectra in it; the stages agree with BSDF sampling alone.
TEST(EnvironmentLight, Oracle) {
  SceneBuilder b;
  const auto white = b.material(diffuse(ConstantSpectrum{0.7}));
  b.floor({0, 0, 0}, 1, 1, white);
  b.quad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2}, white);
  b.sphere({0.3, 0.2, 0.4}, 0.4, 2, b.material(plastic(upsample_reflectance({0.2, 0.3, 0.7}), 0.3f)));
  b.sphere({-0.5, 0.2, 0.35}, 0.3, 2, b.material(solid_glass(1.5f, 0.3f)));
  b.ceiling({0, 0, 1.9}, 0.5, 0.5, b.lamp(fl11(), 1.0, true));
  b.camera({0, -2.5, 1.2}, {0, 0, 0.6}, 50, 16, 16);
  const int spectrum = b.emission(d65());
  Scene built = b.build();
  Image picture(16, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) {
      float* p = picture.at(x, y);
      p[0] = 0.1f * static_cast<float>(x), p[1] = 0.2f * static_cast<float>(y), p[2] = 0.5f;
      if (x / 3 == 2 && y / 2 == 1) p[0] = p[1] = p[2] = 6.0f;
    }
  Environment e(std::move(picture), 60.0);
  e.emission_spectrum = spectrum;
  built.environment = std::make_shared<const Environment>(std::move(e));
  const PreparedScene scene(built);
  const IlluminantWavelengths sampler{4, base_density(scene_emission(scene))};
  RenderOptions o{.spp = 1500, .sequence = Sequence::independent, .seed = 11, .max_depth = 8};
  const RenderResult clever = render(scene, sampler, o);
  o.seed = 12, o.spp = 3000;
  const RenderResult simple = render_naive(scene, sampler, o);
  expect_same_image(clever.film, simple.film, 2, "environment");
  EXPECT_LT(luminance(clever.film).error, 0.005 * luminance(clever.film).mean);
}

/// @param tests how many of its kind a test makes
void expect_as_oracle(Scene scene, std::size_t tests, const char* what, int max_depth = 9) {
  const PreparedScene prepared(std::move(scene));
  const IlluminantWavelengths sampler{4, base_density(scene_emission(prepared))};
  RenderOptions o{.spp = 2000, .sequence = Sequence::independent, .seed = 11, .max_depth = max_depth};
  const RenderResult clever = render(prepared, sampler, o);
  o.seed = 12, o.spp = 6000;
  expect_same_image(clever.film, render_naive(prepared, sampler, o).film, tests, what);
  EXPECT_EQ(clever.stats.non_finite, 0u);
}

/// A room behind two panes, one of them tinted and in part opaque, with a lamp and a sky before them, a
/// second lamp in the room and a rough and a smooth pane that meet one kind of packet.
Scene room_behind_panes() {
  SceneBuilder b;
  const auto white = b.material(diffuse(ConstantSpectrum{0.7}));
  b.floor({0, 0, 0}, 1, 1, white);
  b.quad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2}, white);
  b.quad({-1, -1, 0}, {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2}, white);
  b.ceiling({0, 0, 2}, 1, 1, b.material(thin_glass(1.5f, 0.0f)));
  Material tinted = thin_glass(1.5f, 0.0f);
  tinted.base_color = upsample_reflectance({0.3, 0.6, 0.8}), tinted.transmission = 0.8f;
  b.ceiling({0, 0, 2.1}, 0.6, 1, b.material(tinted));
  b.quad({-0.5, -0.5, 0.3}, {0.5, -0.5, 0.3}, {0.5, 0.2, 0.9}, {-0.5, 0.2, 0.9},
         b.material(thin_glass(1.5f, 0.3f)));
  b.quad({-0.9, 0.4, 0.1}, {0.9, 0.4, 0.1}, {0.9, 0.4, 0.6}, {-0.9, 0.4, 0.6},
         b.material(thin_glass(1.5f, 0.0f)));
  b.ceiling({0.2, 0.1, 3}, 0.4, 0.4, b.lamp(fl11(), 6.0));
  b.ceiling({-0.5, 0.5, 1.5}, 0.1, 0.1, b.lamp(BlackbodySpectrum{2700}, 8.0, true));
  b.camera({0, -2.5, 1.2}, {0, 0, 0.6}, 50, 16, 16);
  const int spectrum = b.emission(d65());
  Scene built = b.build();
  built.environment = std::make_shared<const Environment>(constant_sky(0.5f, spectrum));
  return built;
}

/// Both techniques find lamps and sky through panes: their weights must add up, at every depth, some of which
/// end paths at the panes.
TEST(Panes, Oracle) {
  for (const int max_depth : {2, 3, 4, 9}) expect_as_oracle(room_behind_panes(), 4, "panes", max_depth);
}

/// A pane that lies on water is a surface of it: no shadow ray passes both.
TEST(Panes, OnSolidGlass) {
  SceneBuilder b;
  const auto grey = b.material(diffuse(ConstantSpectrum{0.5}));
  b.floor({0, 0, -0.5}, 2, 2, grey);
  b.box({-0.5, -0.5, -0.4}, {0.5, 0.5, 0.4}, b.material(solid_glass(1.33f, 0.0f)));
  b.ceiling({0, 0, 0.4}, 0.5, 0.5, b.material(thin_glass(1.0f, 0.0f)));
  b.sphere({0, 0, 0}, 0.2, 2, b.lamp(d65(), 5.0));
  b.ceiling({0, 0, 1.5}, 1, 1, grey);
  b.camera({0, -1.5, 0.9}, {0, 0, 1.5}, 50, 16, 16);
  expect_as_oracle(b.build(), 1, "pane on water");
}

/// What covers in part is asked once of each ray, on whichever side of a pane it stands: a leaf of alpha a
/// half.
TEST(Panes, BeforeLeaves) {
  for (const double height : {0.15, 0.25}) {
    SceneBuilder b = floor_scene();
    b.floor({0, 0, 0.2}, 0.5, 0.5, b.material(thin_glass(1.0f, 0.0f)));
    Material leaf = diffuse(ConstantSpectrum{0.0});
    leaf.alpha_mode = AlphaMode::blend, leaf.alpha = 0.5f;
    b.floor({0, 0, height}, 0.5, 0.5, b.material(leaf));
    b.camera({-1.5, 0, 0.1}, {0, 0, 0}, 0.01, 8, 8);
    const int spectrum = b.emission(d65());
    Scene scene = b.build();
    scene.punctual_lights = {{.kind = PunctualLight::Kind::directional,
                              .direction = {0, 0, -1},
                              .intensity = 1.0f,
                              .emission_spectrum = spectrum}};
    expect_luminance(render_finite(PreparedScene(scene), 4000, 3), 0.5 * floor_luminance(1.0), "leaf", 2e-3);
  }
}

/// A room with 300 lamps. @param make_lamps their materials
template <typename MakeLamps>
Scene many_lights(const MakeLamps& make_lamps) {
  SceneBuilder b;
  const auto grey = b.material(diffuse(ConstantSpectrum{0.6}));
  b.box({-2, -2, 0}, {2, 2, 2}, grey, true);
  b.box({-0.9, 0, 0}, {-0.4, 0.5, 0.9}, b.material(metal(upsample_reflectance({0.9, 0.6, 0.3}), 0.4f)));
  b.sphere({0.5, 0.3, 0.5}, 0.4, 2, b.material(solid_glass(1.5f, 0.4f)));
  const std::vector<std::uint32_t> lamps = make_lamps(b);
  for (int i = 0; i < 300; ++i)
    b.ceiling({-1.9 + 0.2 * (i % 20), -1.9 + 0.26 * (i / 20), 1.6 + 0.3 * ((i * 7) % 10) / 10.0}, 0.06, 0.08,
              lamps[static_cast<std::size_t>(i) % lamps.size()]);
  b.camera({0, -1.9, 1.0}, {0, 1, 0.7}, 75, 16, 16);
  return b.build();
}

/// Of three spectra, chosen by wavelength and by the tree, against the oracle.
TEST(ManyLights, Oracle) {
  const PreparedScene scene(many_lights([](SceneBuilder& b) {
    return std::vector{b.lamp(fl11(), 10), b.lamp(BlackbodySpectrum{2700}, 20), b.lamp(d65(), 5, true)};
  }));
  EXPECT_TRUE(scene.lights.several_groups());
  EXPECT_TRUE(scene.lights.uses_normals());
  for (const WavelengthSampler& s :
       {all_samplers(scene_emission(scene))[0], all_samplers(scene_emission(scene))[3]}) {
    RenderOptions o{.spp = 700, .sequence = Sequence::independent, .seed = 5, .max_depth = 6};
    const RenderResult clever = render(scene, s, o);
    o.seed = 6, o.spp = 2000;
    expect_same_image(clever.film, render_naive(scene, s, o).film, 2, std::string(sampler_name(s)));
    EXPECT_EQ(clever.stats.non_finite, 0u);
  }
}

/// Of 30 spectra, which are looked up as they are met.
TEST(ManyLights, OfManyColors) {
  const PreparedScene scene(many_lights([](SceneBuilder& b) {
    std::vector<std::uint32_t> lamps;
    for (int k = 0; k < 30; ++k)
      lamps.push_back(b.lamp(BlackbodySpectrum{1500.0 + 300.0 * k}, 10, k % 3 == 0));
    return lamps;
  }));
  EXPECT_FALSE(scene.lights.several_groups());
  const WavelengthSampler sampler = all_samplers(scene_emission(scene))[3];
  RenderOptions o{.spp = 700, .sequence = Sequence::independent, .seed = 5, .max_depth = 6};
  const RenderResult clever = render(scene, sampler, o);
  o.seed = 6, o.spp = 2000;
  expect_same_image(clever.film, render_naive(scene, sampler, o).film, 2, "colours");
  EXPECT_EQ(clever.stats.non_finite, 0u);
}

}  // namespace
}  // namespace photopic
