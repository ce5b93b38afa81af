// The spectral kernels that every path or pixel runs.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "spectral/color_difference.h"
#include "spectral/illuminants.h"
#include "spectral/rgb_upsampling.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {
namespace {

TabulatedSpectrum fluorescent_lamp() {
  return tabulate_emission(*cie_illuminant("FL11"));
}

/// Neighbouring bumps on 48 nodes: as costly to draw from as an optimised distribution.
WavelengthDistribution bumps(const TabulatedSpectrum& lamp, int count) {
  WavelengthDistribution distribution{base_density(lamp), {}, {}, {}, {}};
  for (int k = 0; k < count; ++k) {
    WavelengthDistribution::Component component;
    for (int i = 0; i < 48; ++i) {
      const double distance = i / 47.0 - (k + 0.5) / count;
      component.nodes.push_back(std::exp(-50.0 * distance * distance));
    }
    component.backwards = k % 2 == 1;
    distribution.components.push_back(component);
  }
  return distribution;
}

template <int N>
void draw(benchmark::State& state, const WavelengthSampler& sampler) {
  double u = 0.5;
  for (auto _ : state) {
    u = u + 0.618033988749895;  // the golden ratio: every stratum alike
    u -= std::floor(u);
    SampledWavelengths<N> w = sample_wavelengths<N>(sampler, u);
    benchmark::DoNotOptimize(w);
  }
  state.SetItemsProcessed(state.iterations());
}

template <int N>
bool add_draws() {
  const TabulatedSpectrum lamp = fluorescent_lamp();
  const WavelengthSampler samplers[] = {UniformWavelengths{N}, VisibleWavelengths{N},
                                        IlluminantWavelengths{N, base_density(lamp)},
                                        OptimizedWavelengths(bumps(lamp, N))};
  for (const WavelengthSampler& sampler : samplers) {
    const std::string name = "draw/" + std::string(sampler_name(sampler)) + "/" + std::to_string(N);
    benchmark::RegisterBenchmark(name.c_str(), draw<N>, sampler);
  }
  return true;
}
const bool added = add_draws<1>() && add_draws<4>() && add_draws<8>() && add_draws<16>();

void upsample(benchmark::State& state) {
  Rgb rgb{0.2, 0.5, 0.7};
  for (auto _ : state) {
    benchmark::DoNotOptimize(rgb);
    SigmoidPolynomial reflectance = upsample_reflectance(rgb);
    benchmark::DoNotOptimize(reflectance);
  }
}
BENCHMARK(upsample);

void evaluate_upsampled(benchmark::State& state) {
  const SigmoidPolynomial reflectance = upsample_reflectance({0.2, 0.5, 0.7});
  float lambda = 550.0f;
  for (auto _ : state) {
    benchmark::DoNotOptimize(lambda);
    float value = reflectance(lambda);
    benchmark::DoNotOptimize(value);
  }
}
BENCHMARK(evaluate_upsampled);

/// A table of `range` knots.
void look_up(benchmark::State& state) {
  std::vector<double> lambda, value;
  const auto knots = static_cast<double>(state.range(0));
  for (double i = 0; i < knots; ++i) {
    lambda.push_back(kLambdaMin + (kLambdaMax - kLambdaMin) * i / (knots - 1));
    value.push_back(1.0 + std::sin(i));
  }
  const TabulatedSpectrum table(lambda, value, Beyond::zero);
  double at = 0.0;
  for (auto _ : state) {
    at += 0.618033988749895;
    at -= std::floor(at);
    benchmark::DoNotOptimize(table(kLambdaMin + (kLambdaMax - kLambdaMin) * at));
  }
}
BENCHMARK(look_up)->Arg(2)->Arg(100)->Arg(100'000);

void color_difference(benchmark::State& state) {
  Lab reference{50, 20, -30}, sample{52, 18, -25};
  for (auto _ : state) {
    benchmark::DoNotOptimize(sample);
    benchmark::DoNotOptimize(delta_e_2000(reference, sample));
  }
}
BENCHMARK(color_difference);

}  // namespace
}  // namespace photopic
