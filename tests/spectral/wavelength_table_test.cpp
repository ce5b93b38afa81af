#include "spectral/wavelength_table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "spectral/guide_table.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

/// The largest value on both sides of a wavelength: single precision is relative to it.
double scale_at(const TabulatedSpectrum& emission, double nm) {
  const auto knots = emission.lambda();
  const auto right = std::upper_bound(knots.begin(), knots.end() - 1, nm) - knots.begin();
  return std::max(emission.value()[right - 1], emission.value()[right]);
}

/// The table at one wavelength, wherever in the path it stands, against the plain look-ups.
template <int N>
void expect_plain(const WavelengthTable& table, const Observer& observer,
                  const std::vector<TabulatedSpectrum>& emissions, const std::vector<double>& wavelengths) {
  std::vector<SampledSpectrum<N>> sampled(emissions.size());
  for (std::size_t i = 0; i + N <= wavelengths.size(); i += N) {
    std::array<double, N> lambda;
    std::copy_n(wavelengths.begin() + i, N, lambda.begin());
    const auto h = table.look_up<N>(lambda, std::span(sampled));
    for (int j = 0; j < N; ++j) {
      const double nm = lambda[j];
      const Xyz plain = observer(nm) * (1.0 / observer.y_integral());
      ASSERT_NEAR(h[0][j], plain.x, 1e-6 * plain.x + 1e-10) << nm;
      ASSERT_NEAR(h[1][j], plain.y, 1e-6 * plain.y + 1e-10) << nm;
      ASSERT_NEAR(h[2][j], plain.z, 1e-6 * plain.z + 1e-10) << nm;
      for (std::size_t k = 0; k < emissions.size(); ++k)
        ASSERT_NEAR(sampled[k][j], emissions[k](nm), 2e-6 * scale_at(emissions[k], nm)) << k << ", " << nm;
    }
  }
}

/// Everywhere, and more often within the cells of the lamp, however narrow; every knot itself too.
std::vector<double> wavelengths_for(const TabulatedSpectrum& lamp, int count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> nm{kLambdaMin, kLambdaMax, std::nextafter(kLambdaMax, 0.0)};
  const auto knots = lamp.lambda();
  nm.insert(nm.end(), knots.begin(), knots.end());
  for (int i = 0; i < count; ++i) {
    nm.push_back(std::clamp(360.0 + 470.0 * uniform(random), kLambdaMin, kLambdaMax));
    const auto cell = static_cast<std::size_t>(uniform(random) * static_cast<double>(knots.size() - 1));
    nm.push_back(std::clamp(knots[cell] + (knots[cell + 1] - knots[cell]) * uniform(random), knots[cell],
                            knots[cell + 1]));
  }
  return nm;
}

TEST(WavelengthTable, IsThePlainLookUp) {
  for (const auto& [name, lamp] : test::hard_lamps()) {
    SCOPED_TRACE(name);
    const std::vector<TabulatedSpectrum> one{lamp};
    const WavelengthTable table(Observer::cie1931(), one);
    expect_plain<1>(table, Observer::cie1931(), one, wavelengths_for(lamp, 500));
    expect_plain<4>(table, Observer::cie1931(), one, wavelengths_for(lamp, 2000));
  }
}

TEST(WavelengthTable, HoldsAnyNumberOfLamps) {
  std::vector<TabulatedSpectrum> lamps;
  expect_plain<4>(WavelengthTable(Observer::cie1964(), lamps), Observer::cie1964(), lamps,
                  {400, 500, 600, 700});
  for (const auto& [name, lamp] : test::hard_lamps()) {
    if (lamps.size() == 11) break;
    lamps.push_back(lamp);
    const WavelengthTable table(Observer::cie1964(), lamps);
    expect_plain<8>(table, Observer::cie1964(), lamps, wavelengths_for(lamp, 400));
    expect_plain<16>(table, Observer::cie1964(), lamps, wavelengths_for(lamps.front(), 400));
  }
}

// Ends at equal places, in a cluster, and at the edges of the steps, whatever the steps' width.
TEST(GuideTable, FindsTheFirstCellThatEndsBeyond) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform;
  for (const double steps_per_unit : {0.3, 1.0, 64.0, 1000.0 / 3.0}) {
    std::vector<double> ends;
    for (int i = 0; i < 60; ++i) ends.push_back(std::round(uniform(random) * 16.0) / 8.0 - 1.0);
    for (int i = 0; i < 60; ++i) ends.push_back(0.3 + 1e-9 * uniform(random));
    std::sort(ends.begin(), ends.end());
    const GuideTable table(-1.0, ends, steps_per_unit);
    std::vector<double> at = ends;
    for (int i = 0; i < 2000; ++i) at.push_back(-1.0 + 2.0 * uniform(random));
    for (const double x : at) {
      const auto beyond = std::upper_bound(ends.begin(), ends.end() - 1, x) - ends.begin();
      ASSERT_EQ(table.find(x), beyond) << x;
    }
  }
}

}  // namespace
}  // namespace photopic
