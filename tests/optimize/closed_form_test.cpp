// One wavelength under R = 1 has a closed form: E = h·I/p, so Σ_axes Var(U E) = ∫|U h I|²/p dλ − |U c|²,
// which p ∝ I·sqrt(hᵀJh), J = UᵀU, makes least (Cauchy and Schwarz): (∫ I·sqrt(hᵀJh) dλ)² − |U c|².
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimize/color_metric.h"
#include "optimize/solver.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

double length(Xyz v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

/// The least value of the asymptotic objective for N = 1, R = 1: midpoint rule in every piece between knots.
double least_value(const TabulatedSpectrum& emission, Xyz white) {
  const Observer& observer = Observer::cie1931();
  const Xyz color = emission_xyz(emission, observer);
  const Xyz c = color * (1.0 / color.y);
  const ColorMetric metric = color_metric(c, white);
  const double scale = 1.0 / (color.y * observer.y_integral());

  std::vector<double> ends(emission.lambda().begin(), emission.lambda().end());
  for (double nm = kLambdaMin; nm <= kLambdaMax; nm += 1.0) ends.push_back(nm);
  std::sort(ends.begin(), ends.end());
  double integral = 0.0;
  constexpr int kParts = 32;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (int part = 0; part < kParts; ++part) {
      const double width = (ends[i + 1] - ends[i]) / kParts, nm = ends[i] + (part + 0.5) * width;
      integral += width * scale * emission(nm) * length(measured(metric, observer(nm)));
    }
  const double mean = length(measured(metric, c));
  return std::sqrt(integral * integral - mean * mean);
}

OptimizeResult optimize_one(const TabulatedSpectrum& emission, int nodes, White white = White::d65) {
  OptimizeOptions options;
  options.wavelengths = 1;
  options.effort = Effort::quick;
  options.nodes = nodes;
  options.target_count = 1;
  options.white = white;
  return optimize_distribution(std::span(&emission, 1), options);
}

class ClosedForm : public testing::TestWithParam<const char*> {};

TEST_P(ClosedForm, IsReachedAndNotPassed) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant(GetParam()));
  const double least = least_value(emission, d65_white());
  for (const auto& [nodes, share] : {std::pair{48, 0.02}, {96, 0.01}, {0, 0.005}}) {
    const WavelengthDistribution found = optimize_one(emission, nodes).distribution;
    EXPECT_EQ(found.components[0].nodes.size(), nodes > 0 ? static_cast<std::size_t>(nodes) : 193u);
    EXPECT_EQ(found.targets.constructed, 1);
    EXPECT_GT(found.value, least * (1.0 - 1e-3)) << nodes << " nodes: nothing can be better";
    EXPECT_LT(found.value, least * (1.0 + share)) << nodes << " nodes";
  }
}

INSTANTIATE_TEST_SUITE_P(Lamps, ClosedForm,
                         testing::Values("FL11", "FL2", "A", "D65", "HP1", "LED-B3", "LED-RGB1"));

TEST(ClosedForm, HoldsForAnAdaptedObserverToo) {
  const TabulatedSpectrum emission = tabulate_emission(*cie_illuminant("A"));
  const Xyz lamp = emission_xyz(emission, Observer::cie1931());
  const double least = least_value(emission, lamp * (1.0 / lamp.y));
  const double found = optimize_one(emission, 96, White::illuminant).distribution.value;
  EXPECT_NEAR(found / least, 1.0, 0.01);
}

}  // namespace
}  // namespace photopic
