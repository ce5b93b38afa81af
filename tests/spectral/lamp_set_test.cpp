#include "spectral/lamp_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "spectral/illuminants.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

TabulatedSpectrum lamp(const char* name) {
  return tabulate_emission(*cie_illuminant(name));
}

std::string digest_of(const std::vector<TabulatedSpectrum>& emissions, const std::vector<double>& powers) {
  return digest(lamp_set(emissions, powers));
}

TEST(LampSet, OneLampStaysAsItIs) {
  const std::vector lamps{lamp("FL11")};
  EXPECT_EQ(digest_of(lamps, {3.0}), digest(lamps[0]));
  EXPECT_EQ(digest_of({lamps[0], lamp("A")}, {3.0, 0.0}), digest(lamps[0])) << "the other is dark";
  EXPECT_EQ(digest_of({lamps[0], lamps[0].scaled(7.0)}, {3.0, 2.0}), digest(lamps[0])) << "the same twice";
  EXPECT_EQ(luminance_shares(lamps), std::vector{1.0});
}

TEST(LampSet, OrderAndScaleAndLastDigitsDoNotMatter) {
  const std::string own = digest_of({lamp("A"), lamp("FL11")}, {2.0, 1.0});
  EXPECT_EQ(digest_of({lamp("FL11"), lamp("A")}, {1.0, 2.0}), own);
  EXPECT_EQ(digest_of({lamp("A").scaled(1e20), lamp("FL11")}, {4e-6, 2e-6}), own);
  EXPECT_EQ(digest_of({lamp("A"), lamp("FL11")}, {2.0, 1.001}), own);
  EXPECT_EQ(digest_of({lamp("A"), lamp("FL11"), lamp("A")}, {1.5, 1.0, 0.5}), own);
}

TEST(LampSet, LampsAndPowersMatter) {
  const std::string own = digest_of({lamp("A"), lamp("FL11")}, {2.0, 1.0});
  EXPECT_NE(digest_of({lamp("A"), lamp("FL11")}, {1.0, 2.0}), own);
  EXPECT_NE(digest_of({lamp("A"), lamp("FL11")}, {2.0, 1.1}), own);
  EXPECT_NE(digest_of({lamp("A"), lamp("FL10")}, {2.0, 1.0}), own);
  EXPECT_NE(digest_of({lamp("A"), lamp("FL11"), lamp("E")}, {2.0, 1.0, 1e-6}), own);
}

TEST(LampSet, TheWeakestOfManyAreOne) {
  std::vector<TabulatedSpectrum> emissions;
  std::vector<double> powers;
  double total = 0.0;
  for (int i = 0; i < 100; ++i) {
    emissions.push_back(tabulate_emission(BlackbodySpectrum{2000.0 + 100.0 * i}));
    powers.push_back(std::pow(10.0, -0.02 * i));
    total += powers.back();
  }
  const std::vector<TabulatedSpectrum> set = lamp_set(emissions, powers);
  ASSERT_EQ(set.size(), 12u);
  EXPECT_NEAR(emission_xyz(mixed_light(set), Observer::cie1931()).y, total, 1e-3 * total);
  int kept = 0;
  for (const TabulatedSpectrum& one : set)
    for (int i = 0; i < 11; ++i) kept += digest(one) == digest(emissions[i]);
  EXPECT_EQ(kept, 11) << "the strongest stay as they are";
  const std::vector<TabulatedSpectrum> backwards(emissions.rbegin(), emissions.rend());
  EXPECT_EQ(digest_of(backwards, {powers.rbegin(), powers.rend()}), digest(set));
}

TEST(LampSet, PowersAreLuminous) {
  const std::vector<TabulatedSpectrum> set =
      lamp_set(std::vector{lamp("A"), lamp("FL11").scaled(1e9)}, std::vector{1.0, 3.0});
  const std::vector<double> shares = luminance_shares(set);
  ASSERT_EQ(set.size(), 2u);
  const std::size_t a = digest(set[0]) == digest(lamp("A")) ? 0 : 1;
  EXPECT_NEAR(shares[a], 0.25, 0.25 * 0.0116) << "a hundredth of a decade, rounded";
  EXPECT_NEAR(shares[0] + shares[1], 1.0, 1e-12);
  EXPECT_NEAR(emission_xyz(set[1 - a], Observer::cie1931()).y, 1.0, 1e-9);
  EXPECT_NEAR(emission_xyz(mixed_light(set), Observer::cie1931()).y, 1.0 / shares[1 - a], 1e-9);
}

TEST(LampSet, PowersMayLieFarApart) {
  const std::vector<TabulatedSpectrum> set =
      lamp_set(std::vector{lamp("A"), lamp("FL11")}, std::vector{1e-100, 1e100});
  const std::vector<double> shares = luminance_shares(set);
  ASSERT_EQ(set.size(), 2u);
  EXPECT_NEAR(std::min(shares[0], shares[1]), 1e-200, 1e-209);
  EXPECT_NE(digest(set), digest_of({lamp("A"), lamp("FL11")}, {1e-99, 1e100}));
}

TEST(LampSet, WithoutLightIsEmpty) {
  EXPECT_TRUE(lamp_set({}, {}).empty());
  EXPECT_TRUE(lamp_set(std::vector{lamp("A")}, std::vector{0.0}).empty());
  EXPECT_NE(digest(std::span<const TabulatedSpectrum>{}), digest(lamp("A")));
  EXPECT_THROW(lamp_set(std::vector{lamp("A")}, {}), std::invalid_argument);
  EXPECT_THROW(lamp_set(std::vector{lamp("A")}, std::vector{-1.0}), std::invalid_argument);
  EXPECT_THROW(lamp_set(std::vector{lamp("A")}, std::vector{std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace photopic
