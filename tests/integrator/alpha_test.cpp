#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "support/instances.h"
#include "textured_square.h"

namespace photopic {
namespace {

using namespace test;

/// A black sheet that covers 30 % takes 30 % of the light behind it; a white one in a furnace is not seen.
TEST(Alpha, BlendIsTheShareOfRays) {
  SceneBuilder b = furnace(d65());
  Material black = diffuse(ConstantSpectrum{0.0});
  black.alpha_mode = AlphaMode::blend;
  black.alpha = 0.3f;
  add_square(b, black, 8);
  expect_luminance(film_of(b.build(), 1024), 0.7 * kLuminance, "black sheet");

  SceneBuilder w = furnace(d65());
  Material white = black;
  white.base_color = ConstantSpectrum{1.0};
  add_square(w, white, 8);
  expect_luminance(film_of(w.build(), 512), kLuminance, "white sheet");
}

/// Two such sheets let 0.7² through: each decides for itself. The shadow behind them is as deep.
TEST(Alpha, ShadowsOfSheets) {
  const auto lit = [](int sheets, int spp) {
    SceneBuilder b;
    b.ceiling({0, 0, 1}, 0.2, 0.2, b.lamp(d65(), 10.0));
    b.floor({0, 0, 0}, 0.05, 0.05, b.material(diffuse(ConstantSpectrum{0.8})));
    Material black = diffuse(ConstantSpectrum{0.0});
    black.alpha_mode = AlphaMode::blend;
    black.alpha = 0.3f;
    const std::uint32_t sheet = b.material(black);
    for (int i = 0; i < sheets; ++i) b.floor({0, 0, 0.5 + 0.1 * i}, 1, 1, sheet);
    b.camera({0.0, -0.3, 0.1}, {0, 0, 0}, 6, 8, 8);
    return film_of(b.build(), spp);
  };
  const double open = luminance(lit(0, 2048)).mean;
  expect_luminance(lit(1, 2048), 0.7 * open, "one sheet", 3e-3);
  expect_luminance(lit(2, 4096), 0.49 * open, "two sheets", 3e-3);
}

/// Instances of one sheet decide for themselves too.
TEST(Alpha, InstancesOfOneSheet) {
  SceneBuilder b = furnace(d65());
  Material black = diffuse(ConstantSpectrum{0.0});
  black.alpha_mode = AlphaMode::blend;
  black.alpha = 0.3f;
  add_square(b, black, 8);
  const auto at = [](double z) { return placement({1, 1, 1}, {0, 0, 1}, 0, {0, 0, z}); };
  const Scene scene = with_instances(b.build(), {at(0), at(0.1)});
  expect_luminance(film_of(scene, 1024), 0.49 * kLuminance, "two instances");
}

/// A mask is all or nothing: of a chess board just its black squares are there.
TEST(Alpha, MaskedChessBoard) {
  Texels board;
  for (int i = 0; i < 64; ++i)
    board.insert(board.end(), {255, static_cast<std::uint8_t>((i / 8 + i) % 2 ? 140 : 110)});
  SceneBuilder b = furnace(d65());
  Material m = textured(diffuse(ConstantSpectrum{0.0}),
                        [&](MaterialTextures& t) { t.base_color = square_texture(8, 2, board); });
  m.base_factor = {0, 0, 0};
  m.alpha_mode = AlphaMode::mask;
  add_square(b, m, 8);
  const Film film = film_of(unwrapped(b), 64);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const Estimate e = block_estimates(film, x, y, x + 1, y + 1)[1];
      EXPECT_NEAR(e.mean, (x + y) % 2 ? 0.0 : kLuminance, 5 * e.error + 1e-3) << x << ' ' << y;
    }
}

/// A lamp that is half transparent gives half the light, found either way.
TEST(Alpha, LampsThatCoverInPart) {
  const auto lit = [](bool half) {
    SceneBuilder b;
    Material lamp = diffuse(ConstantSpectrum{0.0});
    lamp.emission_spectrum = b.emission(d65());
    lamp.emission_luminance = half ? 10.0f : 5.0f;
    lamp.alpha_mode = half ? AlphaMode::blend : AlphaMode::opaque;
    lamp.alpha = 0.5f;
    b.ceiling({0, 0, 0.5}, 0.5, 0.5, b.material(lamp));
    b.floor({0, 0, 0}, 0.5, 0.5, b.material(plastic(ConstantSpectrum{0.5}, 0.3f)));
    b.camera({0.0, -0.8, 0.3}, {0, 0, 0}, 20, 8, 8);
    return film_of(b.build(), 1024, half ? 1 : 2);
  };
  expect_same_image(lit(true), lit(false), 1, "half a lamp");
}

/// The hash that blends knows neither batch nor thread.
TEST(Alpha, BatchesChangeNoBit) {
  SceneBuilder b = furnace(d65());
  Material m = diffuse(ConstantSpectrum{0.5});
  m.alpha_mode = AlphaMode::blend;
  m.alpha = 0.5f;
  for (int i = 0; i < 4; ++i) b.floor({0, 0, 0.1 * i}, 0.5, 0.5, b.material(m));
  b.camera({0, 0, 1.5}, {0, 0, 0}, 40, 16, 16);
  const PreparedScene scene(b.build());
  const IlluminantWavelengths sampler{4, base_density(scene_emission(scene))};
  const auto first = image_estimates(render(scene, sampler, {.spp = 16, .batch_size = 1024}).film);
  for (int batch : {1, 7, 100}) {
    const auto other = image_estimates(render(scene, sampler, {.spp = 16, .batch_size = batch}).film);
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].mean, other[i].mean) << batch;
  }
}

}  // namespace
}  // namespace photopic
