#include "optimize/color_bar.h"

#include <gtest/gtest.h>

#include "spectral/illuminants.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

TEST(ColorBar, EveryBlockAveragesToTheLamp) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("D50"));
  const std::vector<WavelengthSampler> samplers = test::all_samplers(emission, 4, 1);
  const ColorBar bar = color_bar(samplers, emission, 4000, 2, 0.5);
  ASSERT_EQ(bar.width, 4000);
  ASSERT_EQ(bar.height, 2 * 5);
  ASSERT_EQ(bar.pixels.size(), 40000u);
  const Rgb lamp = bar.pixels.back();
  EXPECT_NEAR(linear_srgb_to_xyz(lamp).y, 0.5, 1e-9);
  for (int row = 0; row < bar.height; ++row) {
    Rgb mean;
    for (int i = 0; i < bar.width; ++i) {
      const Rgb& pixel = bar.pixels[row * bar.width + i];
      mean.r += pixel.r / bar.width, mean.g += pixel.g / bar.width, mean.b += pixel.b / bar.width;
    }
    EXPECT_NEAR(mean.r, lamp.r, 0.01) << row;
    EXPECT_NEAR(mean.g, lamp.g, 0.01) << row;
    EXPECT_NEAR(mean.b, lamp.b, 0.01) << row;
  }
}

}  // namespace
}  // namespace photopic
