#include "core/texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "error.h"
#include "spectral/color.h"
#include "support/png.h"

namespace photopic {
namespace {

using test::make_png;
using test::PngColor;

TextureImage decode(const std::string& file) {
  return TextureFile(std::as_bytes(std::span(file)), "test").decode("image");
}

std::string refusal(const std::string& file) {
  try {
    decode(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

template <typename T>
std::vector<int> texels(const TextureImage& image) {
  const auto& list = std::get<std::vector<T>>(image.texels);
  return {list.begin(), list.end()};
}

Texture texture_of(TextureImage image) {
  return {.image = std::make_shared<TextureImage>(std::move(image))};
}

void expect_near(Vec4f a, Vec4f b, float tolerance, const std::string& what = "") {
  EXPECT_NEAR(a.x, b.x, tolerance) << what;
  EXPECT_NEAR(a.y, b.y, tolerance) << what;
  EXPECT_NEAR(a.z, b.z, tolerance) << what;
  EXPECT_NEAR(a.w, b.w, tolerance) << what;
}

TEST(TextureFile, KeepsTheTexelsOfEveryKindOfPng) {
  const std::vector<int> grey{0, 10, 128, 255}, deep{0, 258, 40000, 65535};
  EXPECT_EQ(texels<std::uint8_t>(decode(make_png(2, 2, PngColor::grey, grey))), grey);
  EXPECT_EQ(texels<std::uint16_t>(decode(make_png(2, 2, PngColor::grey, deep, 16))), deep);
  const std::vector<int> rgb{1, 2, 3, 250, 251, 252};
  EXPECT_EQ(texels<std::uint8_t>(decode(make_png(2, 1, PngColor::rgb, rgb))), rgb);
  const std::vector<int> rgb16{1, 2, 3, 65000, 300, 65535};
  EXPECT_EQ(texels<std::uint16_t>(decode(make_png(1, 2, PngColor::rgb, rgb16, 16))), rgb16);
  // A palette becomes what it stands for.
  EXPECT_EQ(
      texels<std::uint8_t>(decode(make_png(3, 1, PngColor::palette, {1, 0, 1}, 8, {9, 8, 7, 200, 100, 50}))),
      (std::vector<int>{200, 100, 50, 9, 8, 7, 200, 100, 50}));
}

/// A colour under little alpha stays what it is.
TEST(TextureFile, AlphaIsNotMultipliedIn) {
  const std::vector<int> rgba{200, 100, 50, 3, 7, 255, 0, 0}, grey_alpha{200, 3, 90, 0};
  const TextureImage a = decode(make_png(2, 1, PngColor::rgba, rgba));
  EXPECT_EQ(texels<std::uint8_t>(a), rgba);
  EXPECT_TRUE(a.has_alpha());
  const TextureImage b = decode(make_png(1, 2, PngColor::grey_alpha, grey_alpha));
  EXPECT_EQ(texels<std::uint8_t>(b), grey_alpha);
  EXPECT_TRUE(b.has_alpha());
  EXPECT_FALSE(decode(make_png(1, 1, PngColor::grey, {5})).has_alpha());
}

TEST(TextureFile, RefusesWhatItCannotRead) {
  EXPECT_NE(refusal("").find("neither a PNG nor a JPEG"), std::string::npos);
  EXPECT_NE(refusal(std::string("RIFF\x10\0\0\0WEBPVP8 ", 16)).find("WebP"), std::string::npos);
  const std::string whole = make_png(64, 64, PngColor::grey, std::vector<int>(64 * 64, 99));
  EXPECT_NE(refusal(whole.substr(0, whole.size() / 2)).find("cut short"), std::string::npos);
  EXPECT_NE(refusal(whole.substr(0, 20)).find("cut short"), std::string::npos);
  // Sizes that these bytes cannot hold are refused by the header alone.
  const std::string vast = make_png(16000, 1, PngColor::grey, std::vector<int>(1, 0));
  EXPECT_NE(refusal(vast).find("damaged"), std::string::npos);
  const std::string empty = make_png(32000, 8000, PngColor::grey, std::vector<int>(8000, 0));
  EXPECT_NE(refusal(empty).find("cannot hold"), std::string::npos);
  const std::string absurd = make_png(900000, 900000, PngColor::grey, std::vector<int>(900000, 0));
  EXPECT_NE(refusal(absurd).find("cannot be read"), std::string::npos);
}

TEST(Texture, DecodesColourAndLeavesAlpha) {
  Texture t = texture_of({"", 1, 1, 4, std::vector<std::uint8_t>{10, 100, 200, 100}});
  expect_near(t({}), {10 / 255.0f, 100 / 255.0f, 200 / 255.0f, 100 / 255.0f}, 1e-6f);
  t.srgb = true;
  const auto linear = [](int code) { return static_cast<float>(srgb_decode(code / 255.0)); };
  expect_near(t({}), {linear(10), linear(100), linear(200), 100 / 255.0f}, 1e-6f);
  // The same codes with 16 bits are the same colours: 65535 = 257·255.
  Texture deep = texture_of({"", 1, 1, 4, std::vector<std::uint16_t>{2570, 25700, 51400, 25700}});
  deep.srgb = true;
  expect_near(deep({}), t({}), 1e-6f);
  const Texture grey = texture_of({"", 1, 1, 2, std::vector<std::uint8_t>{51, 102}});
  expect_near(grey({}), {0.2f, 0.2f, 0.2f, 0.4f}, 1e-6f);
}

/// Texel centres stand at half texels; between them the mix is bilinear.
TEST(Texture, BilinearInClosedForm) {
  const std::vector<std::uint8_t> values{0, 51, 102, 255, 204, 153};
  const Texture t = texture_of({"", 3, 2, 1, values});
  const auto value = [&](int x, int y) { return values[static_cast<std::size_t>(3 * y + x)] / 255.0f; };
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_NEAR(t({(x + 0.5f) / 3, (y + 0.5f) / 2}).x, value(x, y), 1e-6f);
  for (float fx : {0.1f, 0.5f, 0.9f})
    for (float fy : {0.2f, 0.7f}) {
      const float expected = (value(1, 0) * (1 - fx) + value(2, 0) * fx) * (1 - fy) +
                             (value(1, 1) * (1 - fx) + value(2, 1) * fx) * fy;
      EXPECT_NEAR(t({(1.5f + fx) / 3, (0.5f + fy) / 2}).x, expected, 1e-5f);
    }
}

TEST(Texture, NearestTakesTheTexelItLiesIn) {
  Texture t = texture_of({"", 4, 1, 1, std::vector<std::uint8_t>{0, 85, 170, 255}});
  t.nearest = true;
  for (int i = 0; i < 4; ++i)
    for (float within : {0.02f, 0.5f, 0.98f})
      EXPECT_NEAR(t({(static_cast<float>(i) + within) / 4, 0}).x, static_cast<float>(i) / 3, 1e-6f);
}

TEST(Texture, WrapsByItsModes) {
  Texture t = texture_of({"", 3, 1, 1, std::vector<std::uint8_t>{0, 51, 255}});
  for (bool nearest : {false, true})
    for (float u = 0.01f; u < 1.0f; u += 0.07f) {
      t.nearest = nearest;
      t.wrap_u = Wrap::repeat;
      for (float period : {-3.0f, -1.0f, 1.0f, 6.0f}) EXPECT_NEAR(t({u + period, 0}).x, t({u, 0}).x, 1e-4f);
      t.wrap_u = Wrap::mirror;
      for (float period : {-4.0f, 2.0f, 6.0f}) {
        EXPECT_NEAR(t({u + period, 0}).x, t({u, 0}).x, 1e-4f);
        EXPECT_NEAR(t({period - u, 0}).x, t({u, 0}).x, 1e-4f);
      }
      t.wrap_u = Wrap::clamp;
      EXPECT_EQ(t({-u, 0}).x, 0.0f);
      EXPECT_EQ(t({1 + u, 0}).x, 1.0f);
    }
  // Across the seam, repeat mixes the first texel with the last, the others do not.
  t.nearest = false;
  t.wrap_u = Wrap::repeat;
  EXPECT_NEAR(t({0, 0}).x, 0.5f, 1e-6f);
  t.wrap_u = Wrap::mirror;
  EXPECT_EQ(t({0, 0}).x, 0.0f);
  EXPECT_EQ(t({1, 0}).x, 1.0f);
}

TEST(Texture, CoordinatesBeyondAllBounds) {
  for (Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
    Texture t = texture_of({"", 3, 2, 1, std::vector<std::uint8_t>{0, 51, 255, 3, 4, 5}});
    t.wrap_u = t.wrap_v = wrap;
    for (float u : {1e30f, -1e30f, INFINITY, NAN, -1e-30f, 1e8f, std::nextafter(1.0f, 0.0f)})
      for (bool nearest : {false, true}) {
        t.nearest = nearest;
        const Vec4f texel = t({u, -u});
        EXPECT_TRUE(texel.x >= 0.0f && texel.x <= 1.0f) << u;
      }
  }
}

}  // namespace
}  // namespace photopic
