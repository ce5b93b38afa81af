// The spectral kernels that every path or pixel runs.
#include <benchmark/benchmark.h>

#include <cmath>

#include "spectral/color_difference.h"
#include "spectral/rgb_upsampling.h"
#include "spectral/spectrum.h"

namespace photopic {
namespace {

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
