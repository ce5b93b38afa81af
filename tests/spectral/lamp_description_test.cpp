#include "spectral/lamp_description.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spectral/illuminants.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

TabulatedSpectrum cie(const char* name) {
  return tabulate_emission(*cie_illuminant(name));
}

CorrelatedTemperature temperature(const TabulatedSpectrum& lamp) {
  return correlated_temperature(emission_xyz(lamp, Observer::cie1931())).value();
}

// CIE 015:2018, tables of the illuminants' properties.
TEST(ColorTemperature, OfTheStandardIlluminants) {
  EXPECT_NEAR(temperature(cie("A")).kelvin, 2856.0, 1.0);
  EXPECT_NEAR(temperature(cie("A")).duv, 0.0, 1e-5);
  EXPECT_NEAR(temperature(cie("D65")).kelvin, 6504.0, 2.0);
  EXPECT_NEAR(temperature(cie("D65")).duv, 0.0032, 1e-4);
  EXPECT_NEAR(temperature(cie("D50")).kelvin, 5003.0, 2.0);
  EXPECT_NEAR(temperature(cie("FL11")).kelvin, 4000.0, 5.0);
}

TEST(ColorTemperature, OfABlackbodyIsItsOwn) {
  for (const double kelvin : {1050.0, 1800.0, 3200.0, 6500.0, 20000.0}) {
    const CorrelatedTemperature found = temperature(tabulate_emission(BlackbodySpectrum{kelvin}));
    EXPECT_NEAR(found.kelvin, kelvin, 1e-4 * kelvin);
    EXPECT_NEAR(found.duv, 0.0, 1e-6);
  }
}

TEST(ColorTemperature, HasNoMeaningFarFromTheLocus) {
  const auto of_line = [](double nm) {
    return correlated_temperature(
        emission_xyz(tabulate_emission(LineSpectrum{nm, 1.0}), Observer::cie1931()));
  };
  const auto green = of_line(532.0);
  if (green) {
    EXPECT_FALSE(green->meaningful());
  }
  EXPECT_FALSE(of_line(460.0));  // bluer than any blackbody
  const auto beyond = tabulate_emission(BlackbodySpectrum{40000.0});
  EXPECT_FALSE(correlated_temperature(emission_xyz(beyond, Observer::cie1931())));
}

TEST(Lines, OfTheTriphosphorLampAreFound) {
  double share = 0.0;
  bool green = false, mercury = false;
  for (const EmissionLine& line : find_lines(cie("FL11"))) {
    green |= line.wavelength == 545.0 && line.luminance_share > 0.3;
    mercury |= line.wavelength == 435.0;
    EXPECT_LE(line.fwhm, 12.0);
    share += line.luminance_share;
  }
  EXPECT_TRUE(green);
  EXPECT_TRUE(mercury);
  EXPECT_GT(share, 0.6);
  EXPECT_LT(share, 1.0);
}

TEST(Lines, SmoothLampsHaveNone) {
  for (const char* name : {"A", "E", "D65", "LED-B3"}) EXPECT_TRUE(find_lines(cie(name)).empty()) << name;
}

TEST(Lines, AreMeasuredAboveTheirBackground) {
  // A triangle of full width 2 nm at half its height 50, area 100, on a level of 1 over 470 nm.
  const auto lamp =
      tabulate_emission(TabulatedSpectrum({360, 498, 500, 502, 830}, {1, 1, 51, 1, 1}, Beyond::zero));
  const auto lines = find_lines(lamp);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_DOUBLE_EQ(lines[0].wavelength, 500.0);
  EXPECT_NEAR(lines[0].fwhm, 2.0, 1e-9);
  EXPECT_NEAR(lines[0].power_share, 100.0 / 570.0, 1e-9);
  const double y_500 = 0.323, y_integral = 106.857;  // CIE 018:2019
  EXPECT_NEAR(lines[0].luminance_share, 100.0 * y_500 / (100.0 * y_500 + y_integral), 2e-3);
}

TEST(Lines, NeighboursAreToldApartAndPowerCountsOnce) {
  const auto lamp = tabulate_emission(TabulatedSpectrum({360, 575, 576, 577, 578, 579, 580, 830},
                                                        {0, 0, 5, 0.1, 0.1, 4, 0, 0}, Beyond::zero));
  const auto lines = find_lines(lamp);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_DOUBLE_EQ(lines[0].wavelength, 576.0);
  EXPECT_DOUBLE_EQ(lines[1].wavelength, 579.0);
  EXPECT_LE(lines[0].power_share + lines[1].power_share, 1.0);
  EXPECT_GT(lines[0].power_share + lines[1].power_share, 0.9);
}

TEST(LampDescription, OfALine) {
  const LampDescription lamp = describe_lamp(tabulate_emission(LineSpectrum{555.0, 0.01}));
  EXPECT_NEAR(lamp.efficacy, 683.0, 1.0);
  EXPECT_NEAR(lamp.luminance_from, 555.0, 0.01);
  EXPECT_NEAR(lamp.luminance_to, 555.0, 0.01);
  EXPECT_DOUBLE_EQ(lamp.peak.value(), 555.0);
  ASSERT_EQ(lamp.lines.size(), 1u);
  EXPECT_NEAR(lamp.lines[0].luminance_share, 1.0, 1e-9);
}

TEST(LampDescription, DoesNotDependOnScale) {
  const LampDescription one = describe_lamp(cie("FL11"));
  for (const double scale : {1e-30, 1e30}) {
    const LampDescription other = describe_lamp(cie("FL11").scaled(scale));
    EXPECT_NEAR(other.efficacy, one.efficacy, 1e-9 * one.efficacy);
    EXPECT_NEAR(other.chromaticity.x, one.chromaticity.x, 1e-12);
    EXPECT_EQ(other.lines.size(), one.lines.size());
  }
}

// Σȳ·E: 683 lm/W times the photopic average over 470 nm.
TEST(LampDescription, OfEqualEnergyLight) {
  const LampDescription lamp = describe_lamp(tabulate_emission(ConstantSpectrum{1.0}));
  EXPECT_FALSE(lamp.peak);
  EXPECT_NEAR(lamp.efficacy, 683.0 * 106.857 / 470.0, 0.1);
  EXPECT_NEAR(lamp.chromaticity.x, 1.0 / 3.0, 2e-4);
  EXPECT_THROW(describe_lamp(tabulate_emission(ConstantSpectrum{0.0})), std::invalid_argument);
}

}  // namespace
}  // namespace photopic
