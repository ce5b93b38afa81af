#include "spectral/illuminants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "spectral/observer.h"
#include "spectral/spectrum_file.h"

namespace photopic {
namespace {

struct Chromaticity {
  const char* name;
  double x, y;
};

// CIE 15, 2° observer: as published, to four or five digits.
const Chromaticity kPublished[] = {
    {"A", 0.44758, 0.40745},    {"C", 0.31006, 0.31616},     {"D50", 0.34567, 0.35851},
    {"D55", 0.33243, 0.34744},  {"D65", 0.31272, 0.32903},   {"D75", 0.29903, 0.31488},
    {"FL1", 0.3131, 0.3371},    {"FL2", 0.3721, 0.3751},     {"FL3", 0.4091, 0.3941},
    {"FL4", 0.4402, 0.4031},    {"FL5", 0.3138, 0.3452},     {"FL6", 0.3779, 0.3882},
    {"FL7", 0.3129, 0.3292},    {"FL8", 0.3458, 0.3586},     {"FL9", 0.3741, 0.3727},
    {"FL10", 0.3458, 0.3588},   {"FL11", 0.3805, 0.3769},    {"FL12", 0.4370, 0.4042},
    {"FL3.1", 0.4407, 0.4033},  {"FL3.2", 0.3808, 0.3734},   {"FL3.3", 0.3153, 0.3439},
    {"FL3.4", 0.4429, 0.4043},  {"FL3.5", 0.3749, 0.3672},   {"FL3.6", 0.3488, 0.3600},
    {"FL3.7", 0.4384, 0.4045},  {"FL3.8", 0.3820, 0.3832},   {"FL3.9", 0.3499, 0.3591},
    {"FL3.10", 0.3455, 0.3560}, {"FL3.11", 0.3245, 0.3434},  {"FL3.12", 0.4377, 0.4037},
    {"FL3.13", 0.3830, 0.3724}, {"FL3.14", 0.3447, 0.3609},  {"FL3.15", 0.3127, 0.3288},
    {"HP1", 0.5330, 0.4150},    {"HP2", 0.4778, 0.4158},     {"HP3", 0.4302, 0.4075},
    {"HP4", 0.3812, 0.3797},    {"HP5", 0.3776, 0.3713},     {"LED-B1", 0.4560, 0.4078},
    {"LED-B2", 0.4357, 0.4012}, {"LED-B3", 0.3756, 0.3723},  {"LED-B4", 0.3422, 0.3502},
    {"LED-B5", 0.3118, 0.3236}, {"LED-BH1", 0.4474, 0.4066}, {"LED-RGB1", 0.4557, 0.4211},
    {"LED-V1", 0.4548, 0.4044}, {"LED-V2", 0.3781, 0.3775},  {"ID50", 0.3432, 0.3602},
    {"ID65", 0.3107, 0.3307},   {"E", 1.0 / 3, 1.0 / 3},
};

/// The standard's own way: a sum every 5 nm.
Xyz sum_every_5_nm(const TabulatedSpectrum& spectrum) {
  Xyz sum;
  for (double lambda = 380; lambda <= 780; lambda += 5) sum += Observer::cie1931()(lambda) * spectrum(lambda);
  return sum;
}

TEST(Illuminants, PublishedChromaticities) {
  for (const Chromaticity& c : kPublished) {
    const Xyz xyz = sum_every_5_nm(cie_illuminant(c.name).value());
    const double sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, c.x, 1e-4) << c.name;
    EXPECT_NEAR(xyz.y / sum, c.y, 1e-4) << c.name;
  }
}

// The exact integral of the interpolated table is another quadrature, so only near.
TEST(Illuminants, IntegratedChromaticities) {
  for (const Chromaticity& c : kPublished) {
    const Xyz xyz = emission_xyz(tabulate_emission(cie_illuminant(c.name).value()), Observer::cie1931());
    const double sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, c.x, 1e-3) << c.name;
    EXPECT_NEAR(xyz.y / sum, c.y, 1e-3) << c.name;
  }
}

TEST(Illuminants, NamesAreAllKnown) {
  const auto names = cie_illuminant_names();
  EXPECT_EQ(names.size(), std::size(kPublished));
  for (std::string_view name : names) EXPECT_TRUE(cie_illuminant(name)) << name;
  EXPECT_EQ(digest(*cie_illuminant("F11")), digest(*cie_illuminant("FL11")));
  for (std::string_view name : {"", "F", "F13", "FL0", "FL3.16", "d65", "D65 ", "FFL1", "FF1"})
    EXPECT_FALSE(cie_illuminant(name)) << name;
}

/// Three samples where colord has another digit. The published chromaticity of FL10 bears ours out at 605 nm;
/// the other two do not show in it.
bool known_to_differ(const std::string& name, double lambda) {
  return (name == "F5" && lambda == 690) || (name == "F10" && (lambda == 385 || lambda == 605));
}

TEST(Illuminants, AgreeWithColord) {
  const std::filesystem::path folder = "/usr/share/colord/illuminant";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not installed";
  std::vector<std::string> names = {"A", "C", "D65"};
  for (int i = 1; i <= 12; ++i) names.emplace_back("F").append(std::to_string(i));
  for (const std::string& name : names) {
    const auto colord = read_spectrum_file(folder / ("CIE-" + name + ".sp"), Beyond::zero);
    const auto ours = cie_illuminant(name).value();
    // colord's scale is its own, its numbers have four decimals, and their last digit is not always the same.
    double largest = 0.0, colord_largest = 0.0;
    for (double x = 380; x <= 780; x += 5) {
      largest = std::max(largest, ours(x));
      colord_largest = std::max(colord_largest, colord(x));
    }
    for (double x = 380; x <= 780; x += 5) {
      if (known_to_differ(name, x)) continue;
      EXPECT_NEAR(ours(x) / largest, colord(x) / colord_largest, 1e-3) << name << " at " << x;
    }
  }
}

// CIE 15 defines A as Planck's law at 2848 K with c₂ = 1.435e-2 m K: today's c₂ makes that 2855.5 K.
TEST(Illuminants, AIsABlackbody) {
  const auto a = cie_illuminant("A").value();
  const Spectrum body = BlackbodySpectrum{2848.0 * 1.438776877 / 1.435};
  for (double x = 360; x <= 780; x += 5) EXPECT_NEAR(a(x) / 100.0 / evaluate(body, x), 1.0, 1e-5) << x;
}

}  // namespace
}  // namespace photopic
