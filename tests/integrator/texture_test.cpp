#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "support/instances.h"
#include "textured_square.h"

namespace photopic {
namespace {

using namespace test;

double delta_e(Xyz a, Xyz b) {
  const Lab p = xyz_to_lab(a, d65_white()), q = xyz_to_lab(b, d65_white());
  return std::hypot(p.l - q.l, p.a - q.a, p.b - q.b);
}

Xyz texel_xyz(const Texels& rgb, std::size_t i) {
  const auto channel = [&](std::size_t c) { return srgb_decode(rgb[3 * i + c] / 255.0); };
  return linear_srgb_to_xyz({channel(0), channel(1), channel(2)});
}

const Texels kColors{255, 255, 255, 0,   0,  0,   128, 128, 128, 200, 30,  40, 20,  160, 60, 30,
                     60,  190, 230, 200, 20, 120, 30,  140, 250, 128, 64,  64, 128, 250, 12, 14,
                     18,  240, 220, 210, 90, 70,  50,  180, 220, 140, 255, 40, 160, 60,  90, 80};

/// Lit by even daylight from everywhere, a textured square shows its texels' colours.
TEST(Textures, ColoursAreReproduced) {
  SceneBuilder b = furnace(d65());
  add_square(b,
             textured(diffuse(ConstantSpectrum{1.0}),
                      [](MaterialTextures& t) { t.base_color = square_texture(4, 3, kColors); }),
             4);
  const PreparedScene scene(unwrapped(b));
  const RenderResult r =
      render(scene, IlluminantWavelengths{16, base_density(scene_emission(scene))}, {.spp = 512});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const auto i = static_cast<std::size_t>(4 * y + x);
      const std::vector<Estimate> e = block_estimates(r.film, x, y, x + 1, y + 1);
      const Xyz seen = Xyz{e[0].mean, e[1].mean, e[2].mean} * (1.0 / kLuminance);
      EXPECT_LT(delta_e(seen, texel_xyz(kColors, i)), 1.5) << "texel " << i;
    }
}

/// The same colours as an emissive texture and as an unlit material, which a lamp does not light.
TEST(Textures, EmissionShowsItsColours) {
  for (bool unlit : {false, true}) {
    SceneBuilder b;
    Material m = textured(diffuse(ConstantSpectrum{0.0}),
                          [](MaterialTextures& t) { t.emissive = square_texture(4, 3, kColors); });
    m.emission_spectrum = b.emission(d65());
    m.emission_luminance = 2.0f;
    m.unlit = unlit;
    add_square(b, m, 4);
    const PreparedScene scene(unwrapped(b));
    const RenderResult r =
        render(scene, IlluminantWavelengths{16, base_density(scene_emission(scene))}, {.spp = 512});
    for (int i = 0; i < 16; ++i) {
      const std::vector<Estimate> e = block_estimates(r.film, i % 4, i / 4, i % 4 + 1, i / 4 + 1);
      const Xyz seen = Xyz{e[0].mean, e[1].mean, e[2].mean} * 0.5;
      EXPECT_LT(delta_e(seen, texel_xyz(kColors, static_cast<std::size_t>(i))), 1.5) << "texel " << i;
    }
  }
}

/// Of a measured lamp the texture changes the luminance alone: FL11 through a green texel is FL11.
TEST(Textures, MeasuredEmissionKeepsItsSpectrum) {
  const auto image = [](bool textured_lamp) {
    SceneBuilder b;
    Material m = diffuse(ConstantSpectrum{0.0});
    if (textured_lamp)
      m = textured(m, [](MaterialTextures& t) { t.emissive = square_texture(1, 3, {0, 255, 0}); });
    m.emission_spectrum = b.emission(fl11());
    m.emission_luminance = textured_lamp ? 1.0f : 0.7152f;
    m.emission_is_measured = true;
    add_square(b, m, 4);
    return film_of(unwrapped(b), 256);
  };
  expect_same_image(image(true), image(false), 1, "measured");
}

/// A lamp whose light falls between the points that the light sampler looks at is found by chance, and counts
/// in full.
TEST(Textures, SpecksOfLight) {
  constexpr int kSize = 256;
  Texels specks(3 * kSize * kSize, 0);
  for (std::size_t y = 3; y < kSize; y += 4)
    for (std::size_t x = 3; x < kSize; x += 4)
      std::fill_n(specks.begin() + static_cast<std::ptrdiff_t>(3 * (y * kSize + x)), 3, std::uint8_t{255});
  for (const bool other_lamp : {false, true}) {
    SceneBuilder b;
    Material m = textured(diffuse(ConstantSpectrum{0.0}),
                          [&](MaterialTextures& t) { t.emissive = square_texture(kSize, 3, specks); });
    m.emission_spectrum = b.emission(d65());
    m.emission_luminance = 100.0f;
    b.ceiling({0, 0, 0.5}, 0.5, 0.5, b.material(m));
    Material plain = diffuse(ConstantSpectrum{0.0});
    plain.emission_spectrum = m.emission_spectrum;
    plain.emission_luminance = 1.0f;
    if (other_lamp) b.ceiling({40, 0, 0.5}, 0.1, 0.1, b.material(plain));
    b.floor({0, 0, 0}, 0.5, 0.5, b.material(diffuse(ConstantSpectrum{0.5})));
    b.camera({0.0, -0.8, 0.3}, {0, 0, 0}, 20, 4, 4);
    const PreparedScene scene(unwrapped(b));
    const UniformWavelengths sampler{4};
    const RenderResult fast = render(scene, sampler, {.spp = 4096, .sequence = Sequence::independent}),
                       slow = render_naive(scene, sampler,
                                           {.spp = 4096, .sequence = Sequence::independent, .seed = 2});
    EXPECT_GT(luminance(slow.film).mean, 0.0);
    expect_same_image(fast.film, slow.film, 1, other_lamp ? "with another lamp" : "alone");
  }
}

/// A normal map of one constant tilt shades a small square as a square that is tilted so.
class NormalMap : public testing::Test {
 protected:
  /// Lit by a lamp that stands where each tilt sees another part of its light. @param tilt of the normal, in
  /// x (the image's right) and y (its top)
  /// @param material whose `map` is tilted
  static Scene scene(Vec2f tilt, bool mapped, Material m = diffuse(ConstantSpectrum{0.8}),
                     Texture MaterialTextures::*map = &MaterialTextures::normal) {
    SceneBuilder b;
    b.triangle({2, 0.5, 2.0}, {1.6, 1.2, 1.8}, {1.2, 0.4, 2.6}, b.lamp(d65(), 50.0, true));
    const double length = std::sqrt(1.0 + tilt.x * tilt.x + tilt.y * tilt.y);
    const auto code = [&](double v) {
      return static_cast<std::uint16_t>(std::lround((v / length + 1) * 32767.5));
    };
    if (mapped)
      m = textured(m, [&](MaterialTextures& t) {
        (t.*map).image = std::make_shared<TextureImage>(
            TextureImage{"", 1, 1, 3, std::vector<std::uint16_t>{code(tilt.x), code(tilt.y), code(1)}});
      });
    const auto at = [&](double x, double y) { return Vec3d{x, y, mapped ? 0.0 : -tilt.x * x - tilt.y * y}; };
    const double h = 0.01;
    b.quad(at(-h, -h), at(h, -h), at(h, h), at(-h, h), b.material(m));
    b.camera({0, 0, 1}, {0, 0, 0}, 0.5, 8, 8);
    Scene s = b.build();
    constexpr Vec2f kCorners[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    s.geometry.uvs[0].assign(3, {});
    s.geometry.uvs[0].insert(s.geometry.uvs[0].end(), kCorners, kCorners + 4);
    return s;
  }
};

TEST_F(NormalMap, ConstantTiltIsATiltedPlane) {
  for (const Vec2f tilt : {Vec2f{0, 0}, {0.5f, 0}, {-0.5f, 0}, {0, 0.5f}, {0, -0.5f}, {0.3f, -0.6f}}) {
    const double expected = luminance(film_of(scene(tilt, false), 512)).mean;
    expect_luminance(film_of(scene(tilt, true), 512), expected,
                     std::to_string(tilt.x) + " " + std::to_string(tilt.y), 0.01);
  }
}

/// A clearcoat has the normals of its own map alone: not those of the base.
TEST_F(NormalMap, OfClearcoats) {
  Material coat = diffuse(ConstantSpectrum{0.0});
  coat.extensions.clearcoat = 1.0f;
  coat.extensions.clearcoat_roughness = 0.6f;
  for (const Vec2f tilt : {Vec2f{0.5f, 0.2f}, {-0.2f, 0.1f}}) {
    const double expected = luminance(film_of(scene(tilt, false, coat), 2048)).mean;
    expect_luminance(film_of(scene(tilt, true, coat, &MaterialTextures::clearcoat_normal), 2048), expected,
                     std::to_string(tilt.x), 0.01);
    const double flat = luminance(film_of(scene({0, 0}, false, coat), 2048)).mean;
    EXPECT_GT(std::abs(flat / expected - 1), 0.1);
    expect_luminance(film_of(scene(tilt, true, coat), 2048), flat, "of the base", 0.01);
  }
}

/// TANGENT is believed: turned by a quarter about the normal, it turns the tilt. Its w flips the bitangent.
TEST_F(NormalMap, GivenTangents) {
  Scene turned = scene({0.4f, 0.2f}, true);
  turned.geometry.tangents.assign(turned.geometry.positions.size(), {0, 1, 0, 1});
  expect_luminance(film_of(turned, 512), luminance(film_of(scene({-0.2f, 0.4f}, false), 512)).mean, "turned",
                   0.01);
  turned.geometry.tangents.assign(turned.geometry.positions.size(), {1, 0, 0, -1});
  expect_luminance(film_of(turned, 512), luminance(film_of(scene({0.4f, -0.2f}, false), 512)).mean, "flipped",
                   0.01);
}

/// The scale works on x and y before the normal is made unit.
TEST_F(NormalMap, Scale) {
  Scene scaled = scene({0.25f, 0.1f}, true);
  for (Material& m : scaled.materials)
    if (m.textures)
      m = textured(m, [&, old = *m.textures](MaterialTextures& t) { t = old, t.normal_scale = 2.0f; });
  expect_luminance(film_of(scaled, 512), luminance(film_of(scene({0.5f, 0.2f}, false), 512)).mean, "scale",
                   0.01);
}

/// Of an instance the tangent turns and mirrors with it, whether the mesh gives it or not.
TEST_F(NormalMap, Instances) {
  const Affine turned = placement({1, 1, 1}, {0, 0, 1}, std::numbers::pi / 2, {}),
               mirrored = placement({-1, 1, 1}, {0, 0, 1}, 0, {});
  for (const bool given : {false, true})
    for (const auto& [place, tilt] : {std::pair{turned, Vec2f{-0.2f, 0.4f}}, {mirrored, {-0.4f, 0.2f}}}) {
      Scene square = scene({0.4f, 0.2f}, true);
      if (given) square.geometry.tangents.assign(square.geometry.positions.size(), {1, 0, 0, 1});
      const double expected = luminance(film_of(scene(tilt, false), 512)).mean;
      expect_luminance(film_of(with_instances(square, {place}), 512), expected, given ? "given" : "made",
                       0.01);
    }
}

/// Everything at once: the path tracer and the oracle see the same.
TEST(Textures, OracleAgrees) {
  SceneBuilder b = lamp_room(d65(), 8);
  Texels noise, alpha;
  std::uint32_t state = 1;
  const auto next = [&] { return static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24); };
  for (int i = 0; i < 8 * 8 * 4; ++i) noise.push_back(next());
  const auto image = [&](bool srgb, bool linear_filter) {
    Texture t = square_texture(8, 4, noise);
    t.srgb = srgb;
    t.nearest = !linear_filter;
    return t;
  };
  Material leaf = textured(plastic(ConstantSpectrum{0.8}, 0.8f), [&](MaterialTextures& t) {
    t.base_color = image(true, true);
    t.metallic_roughness = image(false, true);
    t.normal = image(false, false);
    t.normal_scale = 0.4f;
    t.clearcoat_normal = image(false, true);
    t.clearcoat_normal_scale = 0.6f;
  });
  leaf.extensions.clearcoat = 0.8f;
  leaf.extensions.clearcoat_roughness = 0.3f;
  leaf.metallic = 0.7f;
  leaf.alpha_mode = AlphaMode::blend;
  b.box({-0.6, -0.2, -0.8}, {0.0, 0.4, 0.0}, b.material(leaf));
  Material glass = textured(thin_glass(1.5f, 0.3f), [&](MaterialTextures& t) {
    t.transmission = image(false, true);
    t.specular = image(false, true);
    t.specular_color = image(true, true);
  });
  b.box({0.2, -0.4, -0.9}, {0.7, 0.3, -0.3}, b.material(glass));
  Material sign = textured(diffuse(ConstantSpectrum{0.2}), [&](MaterialTextures& t) {
    t.base_color = image(true, false);
    t.emissive = image(true, false);
  });
  sign.emission_spectrum = b.emission(d65());
  sign.emission_luminance = 20.0f;
  sign.alpha_mode = AlphaMode::mask;
  sign.double_sided = true;
  b.quad({-0.5, 0.9, -0.5}, {0.5, 0.9, -0.5}, {0.5, 0.9, 0.5}, {-0.5, 0.9, 0.5}, b.material(sign));

  const PreparedScene scene(unwrapped(b));
  const IlluminantWavelengths sampler{4, base_density(scene_emission(scene))};
  const auto options = [](int spp, std::uint32_t seed) {
    return RenderOptions{.spp = spp, .sequence = Sequence::independent, .seed = seed, .max_depth = 6};
  };
  const RenderResult fast = render(scene, sampler, options(2048, 1)),
                     slow = render_naive(scene, sampler, options(8192, 2));
  EXPECT_EQ(fast.stats.non_finite + slow.stats.non_finite, 0u);
  expect_same_image(fast.film, slow.film, 1, "textured room");
}

}  // namespace
}  // namespace photopic
