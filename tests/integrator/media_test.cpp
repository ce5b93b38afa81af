#include "integrator/media.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <tuple>

#include "spectral/observer.h"
#include "support/layered_materials.h"
#include "support/render_checks.h"
#include "support/slabs.h"

namespace photopic {
namespace {

using namespace test;

constexpr double kLamp = 10.0;  // [cd/m²]

/// Looks through layers between z = 0 and their top at an angle, where a lamp no wider than 1 % of the way
/// must be seen in full.
void expect_refracted(SceneBuilder b, const std::vector<Layer>& layers, double sine,
                      const std::string& what) {
  double top = 0.0;
  for (const Layer& layer : layers) top += layer.thickness;
  const Refracted expected = refracted(layers, sine);
  const double slope = sine / std::sqrt(1.0 - sine * sine);
  b.ceiling({expected.offset + slope, 0, top + 1}, 0.01, 0.01, b.lamp(ConstantSpectrum{1.0}, kLamp));
  b.camera({-slope, 0, -1}, {0, 0, 0}, 1e-3, 4, 4);
  // Light that is reflected on its way meets two surfaces more.
  const int surfaces = static_cast<int>(layers.size()) + 2;
  expect_luminance(render_finite(b, 4000, surfaces), kLamp * expected.transmittance, what, 1e-4);
}

/// Shells within shells need no priorities: air, glass, water, ice and back.
TEST(Media, NestedSlabsRefractByTheirRelativeIndices) {
  const std::vector<Layer> layers{
      {1.5, 0.3, 0.5}, {1.33, 0.4, 0.7}, {1.31, 0.5, 0.4}, {1.33, 0.2, 0.7}, {1.5, 0.1, 0.5}};
  for (double sine : {0.0, 0.5, 0.9}) {
    SceneBuilder b;
    b.box({-20, -20, 0}, {20, 20, 1.5}, b.material(tinted(1.5f, 0.5)));
    b.box({-19, -19, 0.3}, {19, 19, 1.4}, b.material(tinted(1.33f, 0.7)));
    b.box({-18, -18, 0.7}, {18, 18, 1.2}, b.material(tinted(1.31f, 0.4)));
    expect_refracted(b, layers, sine, "sine " + std::to_string(sine));
  }
}

/// Air, glass, water, ice, air: neighbours overlap, and the higher priority has the overlap.
TEST(Media, OverlappingSlabsMeetWhereTheHigherPriorityEnds) {
  const std::vector<Layer> layers{{1.5, 0.3, 0.5}, {1.33, 0.4, 0.7}, {1.31, 0.5, 0.4}};
  for (double sine : {0.0, 0.5, 0.9}) {
    SceneBuilder b;
    b.box({-20, -20, 0}, {20, 20, 0.3}, b.material(tinted(1.5f, 0.5, 7)));
    b.box({-19, -19, 0.15}, {19, 19, 0.9}, b.material(tinted(1.33f, 0.7, -2)));
    b.box({-18, -18, 0.7}, {18, 18, 1.2}, b.material(tinted(1.31f, 0.4, 3)));
    expect_refracted(b, layers, sine, "sine " + std::to_string(sine));
  }
}

/// A bubble in water, as a solid of air and as a hole in the water's own mesh.
TEST(Media, BubblesAreAirEitherWay) {
  const std::vector<Layer> layers{{1.33, 0.3, 0.5}, {1.0, 0.2, 1.0}, {1.33, 0.4, 0.5}};
  for (bool hole : {false, true}) {
    SceneBuilder b;
    const auto water = b.material(tinted(1.33f, 0.5));
    b.box({-20, -20, 0}, {20, 20, 0.9}, water);
    b.box({-19, -19, 0.3}, {19, 19, 0.5}, hole ? water : b.material(solid_glass(1.0f, 0.0f)), hole);
    expect_refracted(b, layers, 0.6, hole ? "hole" : "air");
  }
}

/// A white object in a closed box that emits everywhere is not seen, however many glasses it is made of.
void expect_unseen(const std::vector<Material>& shells, const std::string& what) {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.camera({0.1, -1.9, 0.2}, {0, 0, 0}, 45, 12, 12);
  double size = 0.7;
  for (const Material& shell : shells) {
    b.box({-size, -size, -size}, {size, size, size}, b.material(shell));
    size -= 0.4 / static_cast<double>(shells.size());
  }
  const Estimate e = luminance(render_finite(b, shells.front().roughness > 0.0f ? 300 : 100, 400));
  EXPECT_NEAR(e.mean, 3.0, 0.015 + 4.0 * e.error) << what;
  EXPECT_LT(e.error, 0.03) << what;
}

TEST(Media, GlassInGlassKeepsEnergy) {
  Material flint = solid_glass(1.7f, 0.0f);
  flint.extensions.dispersion = glass_index("SF11");
  for (float roughness : {0.0f, 0.3f, 0.7f}) {
    const std::string r = ", roughness " + std::to_string(roughness);
    const auto glass = [&](float ior) { return solid_glass(ior, roughness); };
    flint.roughness = roughness;
    expect_unseen({glass(1.5f), glass(1.33f), glass(1.0f)}, "glass, water, air" + r);
    expect_unseen({glass(1.33f), glass(2.4f)}, "diamond in water" + r);
    expect_unseen({glass(1.5f), glass(1.5f)}, "like in like" + r);
    expect_unseen({flint, glass(1.33f)}, "water in flint" + r);
    expect_unseen({glass(1.33f), flint}, "flint in water" + r);
  }
}

TEST(Media, OpaqueInWaterKeepsEnergy) {
  const Material water = solid_glass(1.33f, 0.0f), white = plastic(ConstantSpectrum{1.0}, 0.3f);
  expect_unseen({water, white}, "plastic");
  expect_unseen({water, coated(white, 0.2f)}, "coat");
  expect_unseen({water, iridescent(white, 400.0f)}, "film");
  expect_unseen({water, perfect_conductor(0.3f)}, "conductor");
}

/// What mirrors of index 1.5, films on them and metals show straight on, in water: reflectances by relative
/// indices.
TEST(Media, OpaqueReflectsByRelativeIndices) {
  const Material black = plastic(ConstantSpectrum{0.0}, 0.0f);
  const Material iron = of_metal("Fe", 0.0f);
  const DielectricIndex index = abbe_index(1.4, 5.0);
  using Reflectance = std::function<double(float water, double lambda)>;
  const Reflectance of_plastic = [](float water, double) { return normal_reflectance(1.5f / water); };
  const Reflectance of_film = [](float water, double lambda) {
    const float phase = static_cast<float>(2.0 * std::numbers::pi * 400.0 / lambda);
    return ThinFilm{water, 1.8f, {1.5f}, phase}.reflectance(1.0f);
  };
  const Reflectance of_iron = [&](float water, double lambda) {
    const ConductorIndex& i = *iron.extensions.conductor;
    return fresnel_conductor(1.0f, static_cast<float>(i.n(lambda)) / water,
                             static_cast<float>(i.k(lambda)) / water);
  };
  const Reflectance of_coat = [&](float, double lambda) {
    const float d = static_cast<float>(refractive_index(index, kLineD));
    const double coat = normal_reflectance(1.5f / d);
    return coat + (1.0 - coat) * of_iron(static_cast<float>(refractive_index(index, lambda)), lambda);
  };
  const std::tuple<const char*, Material, Reflectance> cases[] = {
      {"plastic", black, of_plastic},
      {"layered plastic", with_sheen(black, 0.5f, 1e-9), of_plastic},
      {"film", iridescent(black, 400.0f), of_film},
      {"iron", iron, of_iron},
      {"coated iron", coated(iron, 0.0f), of_coat}};
  for (const auto& [what, material, reflectance] : cases) {
    Material water = solid_glass(1.4f, 0.0f);
    water.extensions.dispersion = index;
    SceneBuilder b;
    b.box({-5, -5, -5}, {5, 5, 5}, b.material(water));
    b.floor({0, 0, 0}, 1, 1, b.material(material));
    b.ceiling({0, 0, 3}, 2, 2, b.lamp(ConstantSpectrum{1.0}, kLamp));
    b.camera({0, 0, 1}, {0, 0, 0}, 0.05, 4, 4);
    double seen = 0.0, whole = 0.0;
    for (double lambda = kLambdaMin + 0.5; lambda < kLambdaMax; lambda += 1.0) {
      const double y = Observer::cie1931()(lambda).y;
      whole += y;
      seen += y * reflectance(static_cast<float>(refractive_index(index, lambda)), lambda);
    }
    const PreparedScene scene(b.build());
    const UniformWavelengths sampler{4};
    const RenderOptions o{.spp = 4000, .sequence = Sequence::independent, .seed = 1, .max_depth = 2};
    expect_luminance(render(scene, sampler, o).film, kLamp * seen / whole, what, 1e-3);
    expect_luminance(render_naive(scene, sampler, o).film, kLamp * seen / whole,
                     std::string(what) + ", oracle", 1e-3);
  }
}

/// Glass that shines.
std::uint32_t shining(SceneBuilder& b, int priority) {
  Material m = tinted(1.4f, 0.5, priority);
  m.emission_spectrum = b.emission(d65());
  m.emission_luminance = 5.0f;
  return b.material(m);
}

/// In glass of a higher priority it is not there: neither paths nor light samples find it.
TEST(Media, HiddenGlassDoesNotShine) {
  for (const bool hidden : {true, false}) {
    SceneBuilder b;
    b.box({-1, -1, -1}, {1, 1, 1}, b.material(tinted(1.5f, 0.9, 5)));
    b.box({-0.7, -0.3, -0.3}, {-0.3, 0.3, 0.3}, shining(b, hidden ? 0 : 5));
    b.sphere({0.4, 0, 0}, 0.3, 2, b.material(diffuse(ConstantSpectrum{0.8})));
    b.camera({0.5, -4, 1}, {0, 0, 0}, 35, 8, 8);
    const PreparedScene scene(b.build());
    const RenderOptions o{.spp = 50, .sequence = Sequence::independent, .seed = 1, .max_depth = 8};
    const double seen = luminance(render(scene, UniformWavelengths{4}, o).film).mean,
                 naive = luminance(render_naive(scene, UniformWavelengths{4}, o).film).mean;
    if (hidden) {
      EXPECT_EQ(seen, 0.0);
      EXPECT_EQ(naive, 0.0);
    } else {
      EXPECT_GT(seen, 0.1);
      EXPECT_GT(naive, 0.1);
    }
  }
}

/// Half of it hidden, from vertices on either side of rough glass and within: light samples find what paths
/// do. @param pane whether a pane stands before the hidden half
void expect_half_hidden(bool pane) {
  SceneBuilder b;
  Material frosted = tinted(1.3f, 0.7, 5);
  frosted.roughness = 0.5f;
  b.box({-1, -1, -1}, {1, 1, 1}, b.material(frosted));
  b.box({-0.9, -0.8, 0.2}, {-0.2, 0.8, 1.6}, shining(b, 0));
  b.box({-0.6, -0.5, -0.8}, {0.2, 0.1, -0.5}, shining(b, 7));
  b.sphere({0.45, 0, 0}, 0.4, 2, b.material(diffuse(ConstantSpectrum{0.8})));
  b.floor({0, 0, -1.2}, 4, 4, b.material(diffuse(ConstantSpectrum{0.8})));
  if (pane)
    b.quad({0, -0.9, -0.4}, {0, 0.9, -0.4}, {0, 0.9, 0.9}, {0, -0.9, 0.9},
           b.material(thin_glass(1.5f, 0.0f)));
  b.camera({1, -4, 2}, {0, 0, 0}, 40, 12, 12);
  const PreparedScene scene(b.turn({0.3, 0.2, 1}, 0.2).build());
  RenderOptions o{.spp = 600, .sequence = Sequence::independent, .seed = 1, .max_depth = 8};
  const RenderResult clever = render(scene, UniformWavelengths{4}, o);
  o.seed = 2, o.spp = 1500;
  expect_same_image(clever.film, render_naive(scene, UniformWavelengths{4}, o).film, 2,
                    pane ? "behind a pane" : "half hidden");
}
TEST(Media, HalfHiddenGlassAgreesWithTheOracle) {
  for (const bool pane : {false, true}) expect_half_hidden(pane);
}

/// More shells than a path remembers: counted, and no energy is made.
TEST(Media, TooManyShellsAreCounted) {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.camera({0, -1.9, 0}, {0, 0, 0}, 50, 8, 8);
  for (int i = 0; i < 12; ++i) {
    const double size = 0.8 - 0.05 * i;
    b.box({-size, -size, -size}, {size, size, size},
          b.material(solid_glass(1.0f + 0.01f * static_cast<float>(i), 0.0f)));
  }
  const PreparedScene scene(b.build());
  const RenderResult r = render(scene, UniformWavelengths{4}, {.spp = 16, .max_depth = 200});
  EXPECT_GT(r.stats.media_overflows, 100u);
  EXPECT_EQ(r.stats.non_finite, 0u);
  EXPECT_NEAR(luminance(r.film).mean, 3.0, 0.1);
}

/// A cup of water with ice: as shells, or of a hollow cup, water that reaches into its wall and a second
/// piece of ice that the first hides.
SceneBuilder cup(bool overlapping, float roughness) {
  SceneBuilder b = lamp_room(fl11(), 12);
  Material glass = tinted(1.5f, 0.3, overlapping ? 2 : 0), water = tinted(1.33f, 0.6),
           ice = tinted(1.31f, 0.1, overlapping ? 1 : 0);
  ice.roughness = roughness;
  const auto g = b.material(glass);
  b.box({-0.7, -0.3, 0.1}, {0.7, 0.7, 1.2}, g);
  const Vec3d low{-0.55, -0.15, 0.25}, high{0.55, 0.55, 1.05}, wall{0.07, 0.07, 0.07};
  if (overlapping) b.box(low, high, g, true);
  b.box(overlapping ? low - wall : low, overlapping ? high + wall : high, b.material(water));
  const auto i = b.material(ice);
  b.box({-0.4, 0, 0.4}, {0.1, 0.4, 0.8}, i);
  if (overlapping) b.box({-0.3, 0.1, 0.5}, {0.1 - 1e-3, 0.3, 0.7}, i);
  return b.turn({0, 0, 1}, 0.2);
}

TEST(Media, OverlapByPriorityEqualsShells) {
  for (float roughness : {0.0f, 0.4f})
    expect_same_image(render_finite(cup(true, roughness), 400, 16, 1),
                      render_finite(cup(false, roughness), 400, 16, 2), 2, std::to_string(roughness));
}

TEST(Media, CupAgreesWithTheOracle) {
  for (float roughness : {0.0f, 0.4f}) {
    const PreparedScene scene(cup(true, roughness).build());
    const RenderOptions options{.sequence = Sequence::independent, .max_depth = 10};
    const auto with = [&](int spp, std::uint32_t seed) {
      RenderOptions o = options;
      o.spp = spp, o.seed = seed;
      return o;
    };
    const UniformWavelengths sampler{4};
    expect_same_image(render(scene, sampler, with(300, 1)).film,
                      render_naive(scene, sampler, with(900, 2)).film, 2, std::to_string(roughness));
  }
}

/// Water of one index around and within dispersive glass, against one wavelength a path.
TEST(Media, DispersionAcrossNestedGlass) {
  for (float roughness : {0.0f, 0.3f}) {
    SceneBuilder b = lamp_room(fl11(), 12);
    Material flint = solid_glass(1.7f, roughness), water = solid_glass(1.33f, roughness);
    flint.extensions.dispersion = abbe_index(1.7, 4.0);
    const auto f = b.material(flint), w = b.material(water);
    b.box({-0.7, -0.3, 0.2}, {0, 0.5, 1}, f), b.box({-0.6, -0.2, 0.3}, {-0.1, 0.4, 0.9}, w);
    b.box({0.1, -0.3, 0.2}, {0.8, 0.5, 1}, w), b.sphere({0.45, 0.1, 0.6}, 0.3, 2, f);
    const PreparedScene scene(b.turn({0, 0, 1}, 0.2).build());
    const auto lamp = base_density(scene_emission(scene));
    const RenderOptions few{.spp = 500, .sequence = Sequence::independent, .seed = 1, .max_depth = 10};
    RenderOptions many = few;
    many.spp = 1200, many.seed = 2;
    expect_same_image(render(scene, IlluminantWavelengths{4, lamp}, few).film,
                      render(scene, IlluminantWavelengths{1, lamp}, many).film, 2, std::to_string(roughness));
  }
}

/// Two solids of one glass that overlap are one solid.
TEST(Media, SolidsOfOneGlassMerge) {
  const auto room = [](bool whole) {
    SceneBuilder b = lamp_room(d65(), 12);
    const auto glass = b.material(tinted(1.5f, 0.2));
    b.box({-0.5, -0.2, 0.2}, {whole ? 0.6 : 0.1, 0.3, 0.9}, glass);
    if (!whole) b.box({-0.1, -0.2, 0.2}, {0.6, 0.3, 0.9}, glass);
    return b.turn({0, 0, 1}, 0.3);
  };
  expect_same_image(render_finite(room(false), 400, 12, 1), render_finite(room(true), 400, 12, 2), 1,
                    "merged");
}

/// From within glass within water radiance is n² times what it is in air: L·n²·τ·Π(1 − F).
TEST(Media, CameraWithinNestedGlass) {
  SceneBuilder b;
  b.box({-5, -5, -0.5}, {5, 5, 0.7}, b.material(tinted(1.33f, 0.5)));
  b.box({-4, -4, -0.3}, {4, 4, 0.3}, b.material(tinted(1.6f, 0.2)));
  b.ceiling({0, 0, 3}, 1, 1, b.lamp(ConstantSpectrum{1.0}, kLamp));
  // What hangs above inside out holds no camera.
  b.box({-9, -9, 5}, {9, 9, 6}, b.material(tinted(2.0f, 0.1)), true);
  b.camera({0, 0, 0.1}, {0, 0, 1}, 1e-3, 4, 4);
  const auto passed = [](float eta) { return 1.0 - fresnel_dielectric(1.0f, eta); };
  const double expected = kLamp * 1.6 * 1.6 * passed(1.33f / 1.6f) * passed(1.0f / 1.33f) *
                          std::pow(0.2, 0.2) * std::pow(0.5, 0.4);
  expect_luminance(render_finite(b, 4000, 3), expected, "within", 1e-4);
}

/// Under an open surface of water, whose depth no mesh bounds: total reflection shows the lamp below, through
/// all the water between.
TEST(Media, CameraUnderOpenWater) {
  SceneBuilder b;
  b.floor({0, 0, 1}, 50, 50, b.material(tinted(1.33f, 0.8)));
  b.floor({6, 0, 0}, 1, 1, b.lamp(ConstantSpectrum{1.0}, kLamp));
  b.camera({0, 0, 0}, {3, 0, 1}, 1e-3, 4, 4);
  expect_luminance(render_finite(b, 100, 2), kLamp * std::pow(0.8, 2 * std::sqrt(10.0)), "mirrored", 1e-4);
  // Straight on there is the same water.
  b.camera({6, 0, 0.5}, {6, 0.01, 0}, 1e-3, 4, 4);
  expect_luminance(render_finite(b, 100, 1), kLamp * std::pow(0.8, std::hypot(0.5, 0.01)), "below", 1e-4);
}

/// There, rough glass that elsewhere would refract nothing meets an index that its mesh's place does not tell
/// of.
TEST(Media, RoughGlassUnderOpenWater) {
  SceneBuilder b;
  b.box({-4, -4, -4}, {4, 4, 4}, b.lamp(ConstantSpectrum{1.0}, kLamp), true);
  b.quad({-4, 3, -4}, {-4, 3, 4}, {4, 3, 4}, {4, 3, -4}, b.material(tinted(1.33f, 1.0)));
  b.sphere({0, 0, 0}, 1, 3, b.material(solid_glass(1.0f, 1.0f)));
  b.camera({0, 0, -3}, {0, 0, 0}, 10, 4, 4);
  const double y = luminance(render_finite(b, 256)).mean;
  EXPECT_GT(y, 0.4 * kLamp);  // without further bounces
  EXPECT_LE(y, 1.001 * kLamp);
}

/// What bounds a path's media, step by step.
TEST(PathMedia, OrderIsByPriorityThenByEntering) {
  const std::vector<Material> materials{tinted(1.5f, 1, 1), tinted(1.33f, 1), tinted(1.31f, 1)};
  const std::vector<Surface> surfaces(materials.begin(), materials.end());
  constexpr std::uint32_t kGlass = 0, kWater = 1, kIce = 2;
  PathMedia media;
  const auto meet = [&](std::uint32_t material, bool from_inside) {
    media.meet(surfaces, Boundary{material, from_inside});
  };
  const auto pass = [&](std::uint32_t material, bool from_inside) {
    meet(material, from_inside);
    media.cross();
  };
  pass(kWater, false);
  EXPECT_EQ(media.current(), 1);
  pass(kGlass, false);
  EXPECT_EQ(media.current(), 0);
  meet(kIce, false);
  EXPECT_TRUE(media.hidden());
  media.cross();
  EXPECT_EQ(media.current(), 0);
  media.meet_screen();
  EXPECT_FALSE(media.hidden());
  EXPECT_EQ(media.on_side(false), 0);
  EXPECT_EQ(media.outside(), 0);
  meet(kWater, true);
  EXPECT_TRUE(media.hidden());
  meet(kGlass, true);
  EXPECT_FALSE(media.hidden());
  EXPECT_EQ(media.outside(), 2);
  EXPECT_EQ(media.on_side(true), 0);
  EXPECT_EQ(media.on_side(false), 2);
  media.cross();
  pass(kIce, true);
  EXPECT_EQ(media.current(), 1);
  pass(kWater, true);
  EXPECT_EQ(media.current(), PathMedia::kVacuum);
  // Never entered, it lay around all the same.
  meet(kWater, true);
  EXPECT_FALSE(media.hidden());
  EXPECT_EQ(media.current(), 1);
  EXPECT_FALSE(media.overflowed());
}

}  // namespace
}  // namespace photopic
