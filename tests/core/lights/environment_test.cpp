#include "core/lights/environment.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/gltf_fixture.h"
#include "core/lights/sky_views.h"
#include "core/sample_sequence.h"
#include "core/scene.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

constexpr double kPiD = std::numbers::pi;

Image grey(int width, int height, const std::function<double(int, int)>& value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) std::fill_n(image.at(x, y), 3, static_cast<float>(value(x, y)));
  return image;
}

/// A sky with a sun of one pixel, dark patches and a black row.
Image uneven_sky() {
  return grey(16, 8, [](int x, int y) {
    if (x == 11 && y == 2) return 5000.0;
    if (y == 6) return 0.0;
    return (x * 7 + y * 5) % 11 < 3 ? 0.0 : 1.0 + (x * 3 + y) % 5;
  });
}

/// As if all of it were seen from everywhere.
SkyViews whole_view(const Environment& e) {
  Scene scene;
  scene.environment = std::shared_ptr<const Environment>(std::shared_ptr<void>(), &e);
  return {Sky(scene), {}, {}};
}

double solid_angle(int width, int height, int y) {
  return 2 * kPiD / width * (std::cos(kPiD * y / height) - std::cos(kPiD * (y + 1) / height));
}

/// A direction in the picture without rotation, x to the right of −z.
Vec3f direction(double x, double y) {
  const double phi = 2 * kPiD * (x - 0.5), theta = kPiD * y;
  return to_float({std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)});
}

TEST(Environment, SamplesFollowTheirDensity) {
  for (double rotation : {0.0, 137.0}) {
    const Environment e(uneven_sky(), rotation), straight(uneven_sky(), 0.0);
    const SkyViews view = whole_view(e), straight_view = whole_view(straight);
    constexpr int kSamples = 200000;
    std::vector<double> observed(128), expected(128);
    double total = 0.0;
    const double c = std::cos(-rotation * kPiD / 180), s = std::sin(-rotation * kPiD / 180);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 16; ++x) {
        const double p =
            straight_view.pdf(straight, 0, direction((x + 0.5) / 16, (y + 0.5) / 8)) * solid_angle(16, 8, y);
        expected[static_cast<std::size_t>(16 * y + x)] = kSamples * p;
        total += p;
      }
    EXPECT_NEAR(total, 1.0, 1e-5);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const auto sample = view.sample<float>(e, 0, SampleStream(Sequence::independent, 6, 0, i).get_2d(0));
      ASSERT_NEAR(length(sample.direction), 1.0f, 1e-5f);
      const Vec3d d = to_double(sample.direction);
      const Vec3d back{d.x * c + d.z * s, d.y, d.z * c - d.x * s};  // as in the picture
      const double x = 16 * (std::atan2(back.x, -back.z) / (2 * kPiD) + 0.5), y = 8 * std::acos(d.y) / kPiD;
      ++observed[static_cast<std::size_t>(16 * std::min(static_cast<int>(y), 7) +
                                          std::min(static_cast<int>(x), 15))];
      const bool inside = std::abs(x - std::round(x)) > 1e-3 && std::abs(y - std::round(y)) > 1e-3;
      if (inside) {
        EXPECT_NEAR(view.pdf(e, 0, sample.direction), sample.pdf, 1e-3f * sample.pdf);
      }
    }
    // Single precision puts a few directions into the pixel beside theirs: none of the black row's own.
    for (std::size_t i = 0; i < 128; ++i) expected[i] = std::max(expected[i], 1e-3);
    double sum = 0.0;
    for (double x : expected) sum += x;
    for (double& x : expected) x *= kSamples / sum;
    EXPECT_GT(chi_square_p_value(observed, expected), 1e-3);
  }
}

/// Wherever the picture is not black there is a density: the mean of L/pdf is ∫ L dω, with bounded weights.
TEST(Environment, ImportanceSamplingFindsAllLight) {
  const Environment e(uneven_sky(), 20.0);
  const SkyViews view = whole_view(e);
  RunningMean mean;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const auto s = view.sample<float>(e, 0, SampleStream(Sequence::independent, 6, 0, i).get_2d(0));
    mean.add(e.radiance(s.direction).y / s.pdf);
  }
  // The same integral with uniform directions, finely stratified.
  double expected = 0.0;
  constexpr int kRows = 800, kColumns = 1600;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x)
      expected +=
          e.radiance(direction((x + 0.5) / kColumns, (y + 0.5) / kRows)).y * solid_angle(kColumns, kRows, y);
  const Estimate found = mean.estimate();
  EXPECT_NEAR(found.mean, expected, 4 * found.error + 1e-3 * expected);
  EXPECT_LT(found.error, 0.02 * expected);
  EXPECT_NEAR(e.flux_density(), expected, 0.02 * expected);  // its rows are weighed as wholes
}

TEST(Environment, Directions) {
  // Red in the middle, green to the right, blue at the top.
  Image image(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      float* p = image.at(x, y);
      p[0] = std::abs(x - 31.5) < 4 && std::abs(y - 15.5) < 4 ? 1.0f : 0.0f;
      p[1] = std::abs(x - 47.5) < 4 && std::abs(y - 15.5) < 4 ? 1.0f : 0.0f;
      p[2] = y < 4 ? 1.0f : 0.0f;
    }
  const Environment e(image, 0.0), turned(image, 90.0);
  EXPECT_EQ(e.radiance({0, 0, -1}), (Vec3f{1, 0, 0}));
  EXPECT_EQ(e.radiance({1, 0, 0}), (Vec3f{0, 1, 0}));
  EXPECT_EQ(e.radiance({0, 1, 0}), (Vec3f{0, 0, 1}));
  EXPECT_EQ(e.radiance({0, -1, 0}), (Vec3f{0, 0, 0}));
  // A quarter turn counter-clockwise from above takes −z to −x and +x to −z.
  EXPECT_EQ(turned.radiance({-1, 0, 0}), (Vec3f{1, 0, 0}));
  EXPECT_EQ(turned.radiance({0, 0, -1}), (Vec3f{0, 1, 0}));
}

/// Sixteen directions at once, those that are none among them.
TEST(Environment, LanesAsOneByOne) {
  const Environment e(uneven_sky(), 33.0);
  const SkyViews view = whole_view(e);
  for (std::uint32_t k = 0; k < 100; ++k) {
    const SampleStreamLanes stream(Sequence::independent, UintLanes{} + 3u, UintLanes{} + k,
                                   UintLanes{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    const Sample2dLanes u = stream.get_2d(0);
    const auto ways = view.sample<Lanes>(e, IntLanes{}, u);
    const Vec3Lanes radiances = e.radiance(ways.direction);
    for (int i = 0; i < kLanes; ++i) {
      const auto way = view.sample<float>(e, 0, lane(u, i));
      EXPECT_NEAR(length(lane(ways.direction, i) - way.direction), 0.0f, 1e-6f);
      EXPECT_NEAR(lane(ways.pdf, i), way.pdf, 1e-4f * way.pdf);
      EXPECT_NEAR(lane(radiances.x, i), e.radiance(lane(ways.direction, i)).x, 1e-3f);
    }
  }
  const Lanes none = Lanes{} + std::numeric_limits<float>::quiet_NaN();
  // Finds some pixel that is there.
  const Vec3Lanes nowhere = e.radiance(Vec3Lanes{none, none, none});
  EXPECT_TRUE(lane(nowhere.x, 5) >= 0.0f && lane(nowhere.x, 5) <= 5000.0f);
}

/// At pixel centres the pixels, in the middle between two their mean; the seam at ±x is none.
TEST(Environment, Bilinear) {
  const Environment e(grey(4, 2, [](int x, int y) { return x + 10.0 * y; }), 0.0);
  EXPECT_NEAR(e.radiance(direction(2.5 / 4, 0.25)).x, 2.0, 1e-4);
  EXPECT_NEAR(e.radiance(direction(2.0 / 4, 0.25)).x, 1.5, 1e-4);
  EXPECT_NEAR(e.radiance(direction(2.5 / 4, 0.5)).x, 7.0, 1e-4);
  EXPECT_NEAR(e.radiance(direction(1e-6, 0.25)).x, 1.5, 1e-4);
  EXPECT_NEAR(e.radiance(direction(1 - 1e-6, 0.25)).x, 1.5, 1e-4);
}

TEST(Environment, ConstantPicture) {
  const Environment e(grey(5, 3, [](int, int) { return 2.0; }), 45.0);
  const SkyViews view = whole_view(e);
  EXPECT_NEAR(e.flux_density(), 8 * kPiD, 1e-5);
  for (const Vec3f& d : {Vec3f{0, 1, 0}, Vec3f{0.6f, -0.8f, 0}, Vec3f{0, 0, 1}}) {
    EXPECT_NEAR(view.pdf(e, 0, d), 1 / (4 * kPiD), 1e-6);
    EXPECT_NEAR(e.radiance(d).z, 2.0, 1e-6);
  }
}

/// ∫ L cos θ dω over the upper half: π where a white ground has 1 cd/m². The horizon has a third of the
/// zenith.
TEST(Environment, OvercastSky) {
  const Environment sky = overcast_sky();
  double illuminance = 0.0;
  constexpr int kRows = 2000;
  for (int y = 0; y < kRows; ++y) {
    const Vec3f d = direction(0.3, 0.5 * (y + 0.5) / kRows);
    illuminance += 2 * kPiD * sky.radiance(d).y * d.y * std::sqrt(1 - d.y * d.y) * (0.5 * kPiD / kRows);
  }
  EXPECT_NEAR(illuminance, kPiD, 2e-3 * kPiD);
  const Vec3f low = direction(0.0, 0.49);
  EXPECT_NEAR(sky.radiance(low).y / sky.radiance({0, 1, 0}).y, (1 + 2 * low.y) / 3, 2e-3);
  EXPECT_NEAR(sky.radiance({0, -1, 0}).y, 0.2, 1e-6);
}

class EnvironmentFile : public GltfTest {
 protected:
  std::filesystem::path image(const std::string& name, float value, float odd) const {
    Image picture(8, 4);
    std::ranges::fill(picture.pixels, value);
    picture.at(3, 2)[1] = odd;
    write_image(folder_ / name, picture);
    return folder_ / name;
  }
  std::string refused(const std::filesystem::path& file) const {
    std::vector<std::string> warnings;
    return message([&] { load_environment({file, 0.0, 1.0}, warnings); });
  }
};

TEST_F(EnvironmentFile, StrengthAndMending) {
  std::vector<std::string> warnings;
  const Environment e = load_environment({image("a.exr", 2.0f, -1.0f), 0.0, 3.0}, warnings);
  EXPECT_NEAR(e.radiance({0, 1, 0}).x, 6.0, 1e-5);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("negative"), std::string::npos);
}

TEST_F(EnvironmentFile, BadFilesAreRefused) {
  EXPECT_NE(refused(folder_ / "none.exr").find("none.exr"), std::string::npos);
  EXPECT_NE(refused(write("text.hdr", "no picture")).find("text.hdr"), std::string::npos);
  EXPECT_NE(refused(image("black.exr", 0.0f, 0.0f)).find("black"), std::string::npos);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refused(image("nan.exr", 1.0f, nan)).find("(3, 2)"), std::string::npos);
}

}  // namespace
}  // namespace photopic
