#include "core/lights/area_light.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/sample_sequence.h"
#include "support/one_light.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

constexpr double kPiD = std::numbers::pi;

/// The solid angle of a triangle seen from zero: Van Oosterom & Strackee 1983, in double.
double solid_angle(Vec3d a, Vec3d b, Vec3d c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2.0 * std::atan2(std::abs(dot(a, cross(b, c))), below);
}

/// A triangle, or the parallelogram that it is half of, as the only lamp of a scene.
struct Lamp {
  Vec3d corner, edge1, edge2;
  bool parallelogram;

  AreaLights lights() const {
    SceneBuilder b;
    const auto material = b.lamp(d65(), 3.0, true);
    if (parallelogram)
      b.quad(corner, corner + edge1, corner + edge1 + edge2, corner + edge2, material);
    else
      b.triangle(corner, corner + edge1, corner + edge2, material);
    return area_lights_of(b.build());
  }

  /// The solid angle of the part between fractions of the edges, from a point; of a triangle the half below
  /// the diagonal.
  double cell(Vec3d from, double x0, double x1, double y0, double y1) const {
    const auto point = [&](double x, double y) { return corner + edge1 * x + edge2 * y - from; };
    const double lower = solid_angle(point(x0, y0), point(x1, y0), point(x0, y1));
    const double upper = solid_angle(point(x1, y0), point(x1, y1), point(x0, y1));
    if (parallelogram || x1 + y1 < 1.0 + 1e-9) return lower + upper;
    return x0 + y0 < 1.0 - 1e-9 ? lower : 0.0;
  }
};

const Lamp kSquare{{-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0}, true};
const Lamp kStrip{{-2, -0.02, 0}, {4, 0, 0}, {0.01, 0.04, 0}, true};
const Lamp kTriangle{{-0.5, -0.3, 0}, {1, 0, 0}, {0.3, 0.7, 0}, false};
const Lamp kSliver{{-1, 0, 0}, {2, 0.01, 0}, {1.2, 0.05, 0}, false};

/// Where they are seen from: afar, near, at a grazing angle, all but touching, and from beside.
const Vec3d kPlaces[] = {{0.1, 0.2, 30},    {0.3, -0.2, 1.5},     {0.2, 0.1, 0.3},     {0.1, 0.05, 0.01},
                         {1.2, 0.9, 0.05},  {0.05, 0.02, 0.0005}, {0.6, 0.4, -0.2},    {3, 0.1, 0.02},
                         {0.52, 0.03, 0.1}, {-0.6, 0.0, 1e-3},    {0.01, 0.013, 1e-4}, {0.5, 0.5, 0.7}};

/// Points of the light in cells of its edges, against the density that each sample says it has: the sum of
/// 1/(density) over a cell estimates its solid angle, and where sampling is uniform in solid angle the counts
/// follow it.
void check_samples(const Lamp& lamp, Vec3d from, const std::string& what) {
  const AreaLights lights = lamp.lights();
  ASSERT_EQ(lights.list().size(), 1u) << what;
  const AreaLight& light = lights.list()[0];
  constexpr int kSamples = 40000, kGrid = 6;
  std::vector<double> counts(kGrid * kGrid), angles(kGrid * kGrid);
  std::vector<RunningMean> sums(kGrid * kGrid);
  double total = 0.0;
  for (int y = 0; y < kGrid; ++y)
    for (int x = 0; x < kGrid; ++x)
      total += angles[static_cast<std::size_t>(y * kGrid + x)] =
          lamp.cell(from, x / 6.0, (x + 1) / 6.0, y / 6.0, (y + 1) / 6.0);

  const double xx = dot(lamp.edge1, lamp.edge1), xy = dot(lamp.edge1, lamp.edge2),
               yy = dot(lamp.edge2, lamp.edge2);
  const double det = xx * yy - xy * xy;
  float least = 1e30f, most = 0.0f;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const auto s = sample_one(light, to_float(from), SampleStream(Sequence::independent, 5, 0, i).get_2d(0));
    ASSERT_TRUE(s) << what;
    EXPECT_NEAR(length(s->direction), 1.0f, 1e-5f);
    // The same density is found again by a ray that hits the point.
    EXPECT_NEAR(light.pdf(to_float(from), s->distance), s->pdf, 2e-4f * s->pdf) << what;
    least = std::min(least, s->pdf), most = std::max(most, s->pdf);

    const Vec3d p = from + to_double(s->direction) * double{s->distance} - lamp.corner;
    const double px = dot(p, lamp.edge1), py = dot(p, lamp.edge2);
    const double u = (px * yy - py * xy) / det, v = (py * xx - px * xy) / det;
    const int x = std::clamp(static_cast<int>(u * kGrid), 0, kGrid - 1);
    const int y = std::clamp(static_cast<int>(v * kGrid), 0, kGrid - 1);
    const auto cell = static_cast<std::size_t>(y * kGrid + x);
    ++counts[cell];
    for (std::size_t c = 0; c < sums.size(); ++c) sums[c].add(c == cell ? 1.0 / s->pdf : 0.0);
  }
  // ∫ pdf dω = 1 on each cell: the mean of 1/pdf is its solid angle.
  const double threshold = normal_threshold(sidak_significance(1e-3, kGrid * kGrid * 48));
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (angles[c] * kSamples < 30 * total) continue;  // too rare for a normal law
    const Estimate e = sums[c].estimate();
    EXPECT_NEAR(e.mean, angles[c], threshold * e.error + 3e-3 * angles[c] + 1e-4 * total)
        << what << " cell " << c;
  }
  if (most > 1.001f * least) return;  // sampled by area
  EXPECT_NEAR(1.0 / most, total, 2e-3 * total) << what;
  std::vector<double> expected;
  for (const double angle : angles) expected.push_back(kSamples * angle / total);
  EXPECT_GT(chi_square_p_value(counts, expected), sidak_significance(0.01, 48)) << what;
}

TEST(AreaLight, SamplesFollowTheirDensity) {
  const std::pair<const char*, Lamp> lamps[] = {
      {"square", kSquare}, {"strip", kStrip}, {"triangle", kTriangle}, {"sliver", kSliver}};
  for (const auto& [name, lamp] : lamps)
    for (const Vec3d& place : kPlaces)
      check_samples(lamp, place,
                    std::string(name) + " from " + std::to_string(place.x) + " " + std::to_string(place.z));
}

/// From the middle of a cube each side fills a sixth of the sphere; pressed against a lamp, a hemisphere.
TEST(AreaLight, KnownSolidAngles) {
  const AreaLights lights = kSquare.lights();
  const AreaLight& light = lights.list()[0];
  EXPECT_NEAR(light.pdf({0, 0, 0.5f}, 0.5f), 1.0 / (4.0 * kPiD / 6.0), 1e-6);
  EXPECT_NEAR(light.pdf({0, 0, 1e-5f}, 1.0f), 1.0 / (2.0 * kPiD), 1e-4);
}

/// Moved 1 km away and shrunk to a millimetre, samples still lie on the light.
TEST(AreaLight, SmallAndFarFromTheOrigin) {
  for (double size : {1.0, 1e-3})
    for (double offset : {0.0, 1e3}) {
      Lamp lamp = kSquare;
      lamp.corner = lamp.corner * size + Vec3d{offset, 0, 0};
      lamp.edge1 = lamp.edge1 * size, lamp.edge2 = lamp.edge2 * size;
      const AreaLights lights = lamp.lights();
      const AreaLight& light = lights.list().at(0);
      const Vec3f from = to_float(Vec3d{offset + 0.3 * size, 0.2 * size, 0.4 * size});
      for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto s = sample_one(light, from, SampleStream(Sequence::sobol, 1, 0, i).get_2d(0));
        if (!s) continue;
        const Vec3f p = from + s->direction * s->distance;
        EXPECT_NEAR(p.z, 0.0, 1e-3 * size + 1e-4 * (offset > 0));
        EXPECT_LE(std::abs(double{p.x} - offset), 0.501 * size + 2e-4 * (offset > 0));
        EXPECT_TRUE(std::isfinite(s->pdf) && s->pdf > 0.0f);
      }
    }
}

/// Two triangles make one light when they are a parallelogram, else two; a triangle knows its light.
TEST(AreaLight, PairsOfTriangles) {
  SceneBuilder b;
  const auto material = b.lamp(d65(), 1.0);
  b.quad({0, 0, 0}, {1, 0, 0}, {1.5, 1, 0}, {0.5, 1, 0}, material);
  b.quad({0, 0, 1}, {1, 0, 1}, {2, 1, 1}, {0.5, 1, 1}, material);  // no parallelogram
  b.triangle({0, 0, 2}, {1, 0, 2}, {2, 0, 2}, material);           // no area
  b.quad({0, 0, 3}, {1, 0, 3}, {1, 1, 3}, {0, 1, 3}, b.material(diffuse(ConstantSpectrum{0.5})));
  b.box({0, 0, 4}, {1, 1, 5}, material);
  const AreaLights lights = area_lights_of(b.build());
  ASSERT_EQ(lights.list().size(), 9u);
  EXPECT_EQ(lights.light_of(0, 0), lights.light_of(0, 1));
  EXPECT_NE(lights.light_of(1, 2), lights.light_of(1, 3));
  EXPECT_EQ(lights.light_of(2, 4), kNoLight);
  double power = 0.0;
  for (std::uint32_t i = 0; i < 9; ++i) power += lights.power(i);
  EXPECT_NEAR(power, kPiD * (1.0 + (0.5 + 0.75) + 6.0), 1e-5);
}

/// Which half of a parallelogram a sample lies on.
TEST(AreaLight, SamplesNameTheirTriangle) {
  SceneBuilder b;
  b.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, b.lamp(d65(), 1.0));
  const Scene scene = b.build();
  const AreaLights lights = area_lights_of(scene);
  for (const Vec3f from : {Vec3f{0.3f, 0.6f, 0.4f}, Vec3f{0.2f, 0.9f, 9.0f}})
    for (std::uint32_t i = 0; i < 200; ++i) {
      const auto s = sample_one(lights.list()[0], from, SampleStream(Sequence::sobol, 3, 0, i).get_2d(0));
      ASSERT_TRUE(s);
      const Vec3f p = from + s->direction * s->distance;
      if (std::abs(p.x - p.y) < 1e-4f) continue;
      EXPECT_EQ(s->triangle, p.x > p.y ? 0u : 1u);  // (0,0) (1,0) (1,1), then (0,0) (1,1) (0,1)
    }
}

TEST(AreaLight, SidesOfALight) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 1, 1, b.lamp(d65(), 1.0));
  const AreaLights lights = area_lights_of(b.build());
  EXPECT_TRUE(sample_one(lights.list()[0], {0, 0, 1}, {0.3f, 0.4f}));
  EXPECT_FALSE(sample_one(lights.list()[0], {0, 0, -1}, {0.3f, 0.4f}));
  EXPECT_FALSE(sample_one(lights.list()[0], {3, 0, 0}, {0.3f, 0.4f}));
}

/// A solid angle knows no scale, though the cube of a distance may be no number.
TEST(AreaLight, DensityIsTheSameAtEveryScale) {
  for (const Lamp& lamp : {kSquare, kTriangle}) {
    const Vec3d from{0.1, 0.2, 30};
    const auto density = [&](double scale) {
      const Lamp scaled{lamp.corner * scale, lamp.edge1 * scale, lamp.edge2 * scale, lamp.parallelogram};
      const AreaLights lights = scaled.lights();
      const auto s = sample_one(lights.list()[0], to_float(from * scale), {0.3f, 0.4f});
      return s ? s->pdf : 0.0f;
    };
    for (const double scale : {1e-12, 1e-3, 1e3, 1e13})
      EXPECT_NEAR(density(scale) / density(1.0), 1.0, 1e-4) << scale;
  }
}

}  // namespace
}  // namespace photopic
