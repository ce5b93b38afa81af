#include "core/light_sampler.h"

#include <gtest/gtest.h>

#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

/// Three lamps: 1 m² of 2 cd/m², 6 m² of 1 cd/m² on both sides, 0.5 m² of 8 cd/m²; powers 2 : 12 : 4.
SceneBuilder three_lamps() {
  SceneBuilder b;
  b.floor({0, 0, 0}, 0.5, 0.5, b.lamp(d65(), 2));
  b.floor({0, 0, 1}, 1.5, 1.0, b.lamp(fl11(), 1, true));
  b.ceiling({0, 0, 2}, 0.25, 0.5, b.lamp(d65(), 8));
  b.floor({0, 0, 3}, 1, 1, b.material(diffuse(ConstantSpectrum{0.5})));
  return b;
}

TEST(LightSampler, ChoosesByPowerAndUniformlyOnSurfaces) {
  const LightSampler lights(three_lamps().build());
  constexpr int kSamples = 200000, kGrid = 8;
  const double power[] = {2.0, 12.0, 4.0}, half_x[] = {0.5, 1.5, 0.25}, half_y[] = {0.5, 1.0, 0.5};
  std::vector<double> observed(3 * kGrid * kGrid), expected;
  for (double p : power)
    for (int i = 0; i < kGrid * kGrid; ++i) expected.push_back(kSamples * p / 18.0 / (kGrid * kGrid));
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const SampleStream stream(Sequence::independent, 8, 0, i);
    const LightSample s = lights.sample(stream.get_1d(0), stream.get_2d(1));
    ASSERT_LT(s.material, 3u);
    const auto m = static_cast<std::size_t>(s.material);
    EXPECT_EQ(s.point.z, static_cast<float>(m));
    const int x = std::min(static_cast<int>(kGrid * 0.5 * (s.point.x / half_x[m] + 1)), kGrid - 1);
    const int y = std::min(static_cast<int>(kGrid * 0.5 * (s.point.y / half_y[m] + 1)), kGrid - 1);
    ++observed[m * kGrid * kGrid + static_cast<std::size_t>(y * kGrid + x)];
  }
  EXPECT_GT(chi_square_p_value(observed, expected), 1e-3);
}

TEST(LightSampler, DensitiesAndNormals) {
  const LightSampler lights(three_lamps().build());
  // Power share over area: luminance over the total of luminance × area × sides.
  const double density[] = {2.0 / 18.0, 2.0 / 18.0, 8.0 / 18.0};
  for (std::uint32_t m = 0; m < 3; ++m) EXPECT_NEAR(lights.pdf_area(m), density[m], 1e-6);
  for (std::uint32_t i = 0; i < 100; ++i) {
    const SampleStream stream(Sequence::sobol, 8, 0, i);
    const LightSample s = lights.sample(stream.get_1d(0), stream.get_2d(1));
    EXPECT_EQ(s.pdf_area, lights.pdf_area(s.material));
    EXPECT_NEAR(s.normal.z, s.material == 2 ? -1.0f : 1.0f, 1e-6f);
  }
}

TEST(LightSampler, PowerOfSpectra) {
  const LightSampler lights(three_lamps().build());
  ASSERT_EQ(lights.power_of_spectrum().size(), 3u);
  EXPECT_NEAR(lights.power_of_spectrum()[0], 2.0, 1e-6);
  EXPECT_NEAR(lights.power_of_spectrum()[1], 12.0, 1e-6);
  EXPECT_NEAR(lights.power_of_spectrum()[2], 4.0, 1e-6);
}

TEST(LightSampler, DarkAndDegenerateLampsAreNotChosen) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 1, 1, b.lamp(d65(), 0.0));
  b.triangle({0, 0, 1}, {1, 0, 1}, {2, 0, 1}, b.lamp(d65(), 5.0));
  EXPECT_TRUE(LightSampler(b.build()).empty());
  const auto bright = b.lamp(d65(), 1e-6);
  b.floor({0, 0, 2}, 1, 1, bright);
  const LightSampler lights(b.build());
  ASSERT_FALSE(lights.empty());
  for (float u : {0.0f, 0.5f, 1.0f - 0x1p-24f}) EXPECT_EQ(lights.sample(u, {0.3f, 0.6f}).material, bright);
}

/// Powers over fifteen decades: the alias table neither loses the weak nor runs out of range.
TEST(LightSampler, ManyLampsOfVeryUnequalPower) {
  SceneBuilder b;
  for (int i = 0; i < 100; ++i) b.floor({0, 0, i * 1.0}, 1, 1, b.lamp(d65(), std::pow(10.0, 0.15 * i - 7.0)));
  const LightSampler lights(b.build());
  constexpr int kSamples = 100000;
  std::vector<double> observed(100), expected;
  for (std::uint32_t m = 0; m < 100; ++m) expected.push_back(kSamples * 4.0 * lights.pdf_area(m));
  for (std::uint32_t i = 0; i < kSamples; ++i)
    ++observed[lights.sample(SampleStream(Sequence::independent, 1, 0, i).get_1d(0), {0.2f, 0.4f}).material];
  EXPECT_GT(chi_square_p_value(observed, expected), 1e-3);
}

}  // namespace
}  // namespace photopic
