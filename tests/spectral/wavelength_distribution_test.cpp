#include "spectral/wavelength_distribution.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "error.h"
#include "spectral/illuminants.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

class DistributionFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("photopic-distribution-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    file_ = folder_ / "lamp.json";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string text() const {
    std::ifstream in(file_);
    return (std::ostringstream() << in.rdbuf()).str();
  }
  /// Writes the good file with one part replaced, and returns what reading it complains of.
  std::string complaint(const std::string& part, const std::string& replacement) {
    write_distribution(file_, good_);
    std::string json = text();
    const auto at = json.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    json.replace(at, part.size(), replacement);
    std::ofstream(file_) << json;
    try {
      read_distribution(file_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_, file_;
  WavelengthDistribution good_ =
      test::random_distribution(tabulate_emission(*cie_illuminant("FL11")), 4, 17, 1);
};

TEST(BaseDensity, IsTheVisiblePowerOfTheLamp) {
  // For equal energy, b is proportional to c = 0.6 x̄ + ȳ + 0.35 z̄ up to the defensive share.
  const PiecewiseLinearDensity base = base_density(tabulate_emission(ConstantSpectrum{3.0}), 0.02);
  const auto c = [](double nm) {
    const Xyz h = Observer::cie1931()(nm);
    return 0.6 * h.x + h.y + 0.35 * h.z;
  };
  const auto without = [&](double nm) { return base.density(nm) - 0.02 / 470.0; };
  EXPECT_NEAR(without(450.0) / without(555.5), c(450.0) / c(555.5), 1e-9);
  EXPECT_NEAR(without(620.25) / without(555.5), c(620.25) / c(555.5), 1e-9);
  EXPECT_NEAR(base.density(830.0), 0.02 / 470.0, 1e-6);
}

TEST(BaseDensity, KeepsTheShareOfANarrowLine) {
  // The line holds as much power as the flat part over 100 nm.
  const TabulatedSpectrum lamp({500.0, 549.99, 550.0, 550.01, 600.0}, {1.0, 1.0, 1e4 + 1.0, 1.0, 1.0},
                               Beyond::zero);
  const PiecewiseLinearDensity base = base_density(tabulate_emission(lamp), 0.0);
  const double line = base.cdf(550.01) - base.cdf(549.99);
  EXPECT_NEAR(line, 0.5, 0.1);
  EXPECT_EQ(base.cdf(500.0), 0.0);
  EXPECT_EQ(base.cdf(600.0), 1.0);
  EXPECT_GT(base.density(500.0), 0.0) << "the table's end is a jump, not a ramp";
  EXPECT_EQ(base.density(499.9), 0.0);
}

TEST(BaseDensity, RefusesDarkness) {
  EXPECT_THROW(base_density(TabulatedSpectrum({400.0, 500.0}, {0.0, 0.0}, Beyond::zero)),
               std::invalid_argument);
  EXPECT_THROW(base_density(TabulatedSpectrum({100.0, 200.0}, {1.0, 1.0}, Beyond::zero)),
               std::invalid_argument);
}

TEST_F(DistributionFile, ComesBackToTheLastBit) {
  good_.spectrum = "cie:FL11, \"quoted\"";
  good_.spectrum_digest = "0123456789abcdef";
  good_.objective = "asymptotic";
  good_.optimize_seconds = 0.1;
  good_.value = 2.3456789012345678;
  good_.targets = {"illuminant", 48, 7, 24, "paints.csv", "fedcba9876543210"};
  good_.illuminant_value = 12.5, good_.visible_value = 1.0 / 3.0, good_.uniform_value = 30.0;
  write_distribution(file_, good_);
  const WavelengthDistribution read = read_distribution(file_);
  EXPECT_EQ(read.spectrum, good_.spectrum);
  EXPECT_EQ(read.spectrum_digest, good_.spectrum_digest);
  EXPECT_EQ(read.objective, good_.objective);
  EXPECT_EQ(read.optimize_seconds, good_.optimize_seconds);
  EXPECT_EQ(read.targets.white, "illuminant");
  EXPECT_EQ(read.targets.constructed, 48);
  EXPECT_EQ(read.targets.seed, 7u);
  EXPECT_EQ(read.targets.measured, 24);
  EXPECT_EQ(read.targets.measured_file, "paints.csv");
  EXPECT_EQ(read.targets.measured_digest, "fedcba9876543210");
  EXPECT_EQ(read.value, good_.value);
  EXPECT_EQ(read.illuminant_value, good_.illuminant_value);
  EXPECT_EQ(read.visible_value, good_.visible_value);
  EXPECT_EQ(read.uniform_value, good_.uniform_value);
  const WavelengthSampler a = OptimizedWavelengths(good_), b = OptimizedWavelengths(read);
  for (int i = 0; i < 1000; ++i) {
    const auto drawn = sample_wavelengths<4>(a, i / 1000.0), again = sample_wavelengths<4>(b, i / 1000.0);
    EXPECT_EQ(drawn.lambda, again.lambda);
    EXPECT_EQ(drawn.density_sum, again.density_sum);
  }
}

TEST_F(DistributionFile, LeavesNothingBehind) {
  write_distribution(file_, good_);
  write_distribution(file_, good_);
  const auto entries = std::filesystem::directory_iterator(folder_);
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
  EXPECT_THROW(write_distribution(folder_ / "nowhere" / "lamp.json", good_), InputError);
}

TEST_F(DistributionFile, LinksAreFollowed) {
  std::filesystem::create_directories(folder_ / "store");
  std::ofstream(folder_ / "store" / "real.json") << "old";
  std::filesystem::create_symlink("store/real.json", file_);
  write_distribution(file_, good_);
  EXPECT_TRUE(std::filesystem::is_symlink(file_));
  EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(folder_ / "store/real.json")));
  EXPECT_EQ(read_distribution(folder_ / "store" / "real.json").components.size(), 4u);
}

TEST_F(DistributionFile, NamesWhatIsWrongAndWhere) {
  const auto expect = [&](const std::string& part, const std::string& replacement, const std::string& place) {
    const std::string problem = complaint(part, replacement);
    EXPECT_NE(problem.find("lamp.json"), std::string::npos) << problem;
    EXPECT_NE(problem.find(place), std::string::npos) << part << " -> " << replacement << ": " << problem;
    EXPECT_EQ(problem.find('\n'), std::string::npos);
  };
  expect("\"version\": 3", "\"version\": 1", "#/version");
  expect("\"version\": 3", "\"new\": 1, \"version\": 4", "#/version");
  expect("\"version\"", "\"vision\"", "\"version\" is missing");
  expect("\"stepped\"", "\"new\": 1, \"stepped\"", "unknown key \"new\"");
  expect("\"value\": 0.0", "\"value\": \"0\"", "#/value");
  expect("\"value\": 0.0", "\"value\": 1e999", "");
  expect("\"value\": 0.0,", "", "\"value\" is missing");
  expect("\"nodes\": [", "\"nodes\": [-1.0,", "#/components/0/nodes/0");
  expect("\"nodes\": [", "\"nodes\": [1.0,", "#/components/1");
  expect("\"nm\": [", "\"nm\": [900.0,", "#/base");
  expect("\"nm\": [", "\"nm\": [null,", "#/base/nm/0");
  expect("\"components\": [", "\"components\": [], \"rest\": [", "rest");
  expect("\"measured\": 0", "\"measured\": -1", "#/targets/measured");
  expect("\"stepped\": false", "\"stepped\": 0", "#/stepped");
  expect("\"backwards\": ", "\"backwards\": 1, \"was\": ", "was");
  expect("{", "[", "");
  expect("{", "{{", "");
}

/// Wavelengths that the base leaves out are drawn by no density: the picture would lack their light.
TEST_F(DistributionFile, TheBaseLeavesNoGap) {
  good_.base = PiecewiseLinearDensity({360.0, 500.0, 500.0, 830.0}, {1.0, 1.0, 2.0, 2.0});
  EXPECT_EQ(complaint("360.0", "360.0"), "");
  const auto of_base = [&](std::vector<double> nm, std::vector<double> density) {
    good_.base = PiecewiseLinearDensity(std::move(nm), std::move(density));
    return complaint("360", "360");
  };
  EXPECT_NE(of_base({360.0, 500.0, 830.0}, {1.0, 0.0, 1.0}).find("#/base/density/1"), std::string::npos);
  EXPECT_NE(of_base({360.0, 500.0, 500.0, 600.0, 600.0, 830.0}, {1.0, 1.0, 0.0, 0.0, 1.0, 1.0})
                .find("#/base/density/2"),
            std::string::npos);
  EXPECT_NE(of_base({360.0, 829.0}, {1.0, 1.0}).find("360 to 830 nm"), std::string::npos);
  good_.base = PiecewiseLinearDensity({361.0, 830.0}, {1.0, 1.0});
  EXPECT_NE(complaint("361", "361").find("#/base/nm"), std::string::npos);
}

TEST_F(DistributionFile, StepsMayBeZeroButLeaveNoGap) {
  good_.stepped = true;
  good_.components = {{{1.0, 0.0, 2.0}}, {{0.0, 3.0, 0.0}}};
  write_distribution(file_, good_);
  const WavelengthDistribution read = read_distribution(file_);
  EXPECT_TRUE(read.stepped);
  EXPECT_EQ(read.components[0].nodes, good_.components[0].nodes);
  good_.components[1].nodes = {1.0, 0.0, 0.0};
  EXPECT_NE(complaint("3", "3").find("zero in cell 1"), std::string::npos);
  good_.components[1].nodes = {0.0, 0.0, 0.0};
  EXPECT_NE(complaint("3", "3").find("zero everywhere"), std::string::npos);
  good_.stepped = false;
  good_.components[1].nodes = {0.0, 3.0, 0.0};
  EXPECT_NE(complaint("3", "3").find("#/components/0/nodes/1"), std::string::npos);
}

TEST_F(DistributionFile, RefusesMoreThanSixteen) {
  good_.components.resize(17, good_.components[0]);
  write_distribution(file_, good_);
  EXPECT_THROW(read_distribution(file_), InputError);
  good_.components.clear();
  write_distribution(file_, good_);
  EXPECT_THROW(read_distribution(file_), InputError);
  EXPECT_THROW(read_distribution(folder_ / "absent.json"), InputError);
}

}  // namespace
}  // namespace photopic
