#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "spectral/observer.h"
#include "spectral/wavelength_sampler.h"

namespace photopic::test {

/// The mean over u of Σ_j h(λ_j) I(λ_j)/S(λ_j), by Gauss–Legendre quadrature in each smooth piece of u.
inline Xyz mean_estimate(const WavelengthSampler& sampler, const TabulatedSpectrum& emission) {
  std::vector<double> knots(emission.lambda().begin(), emission.lambda().end());
  for (double nm = kLambdaMin; nm <= kLambdaMax; nm += 1.0) knots.push_back(nm);
  std::vector<double> ends = breakpoints(sampler, knots);
  ends.insert(ends.begin(), 0.0);
  ends.push_back(1.0);

  constexpr double kPoint[] = {0.0, 0.5384693101056831,
                               0.9061798459386640};  // five points, Abramowitz & Stegun 25.4
  constexpr double kWeight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const auto count = static_cast<std::size_t>(wavelength_count(sampler));
  std::vector<double> lambda(count), sum(count);
  Xyz mean;
  const auto add = [&](double u, double weight) {
    draw_wavelengths(sampler, u, lambda, sum);
    for (std::size_t j = 0; j < count; ++j)
      mean += Observer::cie1931()(lambda[j]) * (weight * emission(lambda[j]) / sum[j]);
  };
  const auto add_piece = [&](double from, double to) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    add(middle, half * kWeight[0]);
    for (const int p : {1, 2})
      for (const double side : {-1.0, 1.0}) add(middle + side * half * kPoint[p], half * kWeight[p]);
  };
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    // λ(u) runs like a root where its density begins low: finer towards both ends.
    const double width = ends[i + 1] - ends[i];
    double from = 0.0;
    for (const double to : {1e-5, 1e-3, 0.01, 0.1, 0.4, 0.6, 0.9, 0.99, 0.999, 0.99999, 1.0}) {
      add_piece(ends[i] + from * width, ends[i] + to * width);
      from = to;
    }
  }
  return mean * (1.0 / Observer::cie1931().y_integral());
}

/// Each of X, Y and Z that there is, relatively.
inline void expect_same_xyz(const Xyz& found, const Xyz& wanted, double tolerance, const std::string& what) {
  EXPECT_NEAR(found.x / wanted.x, 1.0, tolerance) << what;
  EXPECT_NEAR(found.y / wanted.y, 1.0, tolerance) << what;
  if (wanted.z > 0.0) {
    EXPECT_NEAR(found.z / wanted.z, 1.0, tolerance) << what;
  }
}

/// N densities of random nodes, rough or smooth, randomly oriented.
inline WavelengthDistribution random_distribution(const TabulatedSpectrum& emission, int count, int nodes,
                                                  std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  WavelengthDistribution distribution{.base = base_density(emission), .components = {}};
  for (int k = 0; k < count; ++k) {
    WavelengthDistribution::Component component;
    for (int b = 0; b < nodes; ++b) component.nodes.push_back(std::exp(8.0 * uniform(random) - 4.0));
    component.backwards = uniform(random) < 0.5;
    distribution.components.push_back(component);
  }
  return distribution;
}

/// All four samplers for a lamp.
inline std::vector<WavelengthSampler> all_samplers(const TabulatedSpectrum& emission, int count,
                                                   std::uint64_t seed) {
  return {UniformWavelengths{count}, VisibleWavelengths{count},
          IlluminantWavelengths{count, base_density(emission)},
          OptimizedWavelengths(random_distribution(emission, count, 31, seed))};
}

/// Noise and a line in as many rows as a spectrometer may give.
inline TabulatedSpectrum dense_lamp(int rows) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> nm, value;
  for (int i = 0; i < rows; ++i) {
    nm.push_back(380.0 + 400.0 * i / (rows - 1));
    value.push_back(uniform(random) + (std::abs(nm.back() - 546.1) < 0.3 ? 30.0 : 0.0));
  }
  return tabulate_emission(TabulatedSpectrum(std::move(nm), std::move(value), Beyond::zero));
}

inline std::vector<std::pair<std::string, TabulatedSpectrum>> hard_lamps() {
  const auto table = [](std::vector<double> nm, std::vector<double> value) {
    return tabulate_emission(TabulatedSpectrum(std::move(nm), std::move(value), Beyond::zero));
  };
  std::vector<std::pair<std::string, TabulatedSpectrum>> lamps{
      {"0.01 nm line", tabulate_emission(LineSpectrum{546.1, 0.01})},
      {"two samples", table({450.0, 650.0}, {1.0, 2.0})},
      {"ends inside", table({500.0, 505.0, 600.0}, {3.0, 1.0, 5.0})},
      {"zero outside", table({360.0, 430.0, 431.0, 660.0, 661.0, 830.0}, {0, 0, 1, 2, 0, 0})},
      {"nearly all ultraviolet", table({200.0, 365.0, 375.0, 400.0, 401.0}, {9.0, 9.0, 9.0, 1.0, 0.0})},
      {"dark gaps",
       table({440.0, 441.0, 442.0, 540.0, 541.0, 542.0, 610.0, 611.0, 612.0}, {0, 5, 0, 0, 9, 0, 0, 4, 0})},
      {"three 0.01 nm lines", table({435.83, 435.84, 435.85, 546.06, 546.07, 546.08, 611.6, 611.61, 611.62},
                                    {0, 5, 0, 0, 9, 0, 0, 4, 0})},
      {"steps", table({400.0, 450.0, 450.0, 550.0, 550.0, 700.0}, {1, 1, 0, 0, 2, 2})},
      {"1e-30", table({380.0, 560.0, 780.0}, {1e-30, 2e-30, 1e-30})},
      {"1e30", table({380.0, 560.0, 780.0}, {1e30, 2e30, 1e30})},
      {"20,000 samples", dense_lamp(20000)}};
  const std::vector<TabulatedSpectrum> pair{
      table({360.0, 450.0, 560.0, 830.0}, {0.5, 1.1, 1.0, 0.6}),
      tabulate_emission(LineSpectrum{532.0, 0.01})};  // of power 400 and 0.01
  for (const double ratio : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    lamps.emplace_back("daylight and a line of this times its power: " + std::to_string(ratio),
                       mix_emissions(pair, std::vector{1.0, 4e4 * ratio}));
  return lamps;
}

}  // namespace photopic::test
