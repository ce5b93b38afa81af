#include "core/upsampling_lanes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/sample_sequence.h"
#include "spectral/rgb_table.h"

namespace photopic {
namespace {

/// Colours of all kinds: at random, dark, nearly and wholly grey, with channels of 0 and 1, outside the cube.
std::vector<Vec3f> colors() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Vec3f> list{{0, 0, 0},       {1, 1, 1},       {0.5f, 0.5f, 0.5f},  {1, 0, 0},
                          {0, 1, 0},       {0, 0, 1},       {1, 1, 0},           {0, 1, 1},
                          {-1, 0.5f, 2},   {kNan, 0.3f, 0}, {1e-20f, 0, 0},      {0, 1e-6f, 1e-7f},
                          {0.2f, 0.2f, 0}, {0.2f, 0, 0.2f}, {0.5f, 0.5f, 0.501f}};
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const SampleStream random(Sequence::independent, 1, 0, i);
    const float scale = i % 3 == 0 ? random.get_1d(3) * 0.01f : 1.0f;
    list.push_back(Vec3f{random.get_1d(0), random.get_1d(1), random.get_1d(2)} * scale);
  }
  list.resize(list.size() / kLanes * kLanes);
  return list;
}

TEST(UpsamplingLanes, AreTheTableForEachColor) {
  const std::vector<Vec3f> list = colors();
  for (std::size_t first = 0; first < list.size(); first += kLanes) {
    Vec3Lanes rgb;
    for (int i = 0; i < kLanes; ++i) set_lane(rgb, i, list[first + static_cast<std::size_t>(i)]);
    const SigmoidLanes lanes = tabulated_reflectance(rgb);
    const SpectrumLanes<4> values = lanes(SpectrumLanes<4>(Lanes{} + 550.0f));
    for (int i = 0; i < kLanes; ++i) {
      const Vec3f c = list[first + static_cast<std::size_t>(i)];
      const SigmoidPolynomial one = tabulated_reflectance(c.x, c.y, c.z);
      const float tolerance = 1e-4f * (std::abs(one.c0) + std::abs(one.c1) + std::abs(one.c2)) + 1e-6f;
      EXPECT_NEAR(lanes.c0[i], one.c0, tolerance) << c.x << ' ' << c.y << ' ' << c.z;
      EXPECT_NEAR(lanes.c1[i], one.c1, tolerance);
      EXPECT_NEAR(lanes.c2[i], one.c2, tolerance);
      for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(values.v[j][i], one(550.0f), 2e-5f);
    }
  }
}

}  // namespace
}  // namespace photopic
