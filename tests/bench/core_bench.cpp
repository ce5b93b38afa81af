// What every path does beside tracing rays and shading: its numbers, its wavelengths, its camera ray,
// spectra, light samples, the film.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/camera.h"
#include "core/compiled_sampler.h"
#include "core/film.h"
#include "core/lights/area_light_lanes.h"
#include "core/sample_sequence.h"
#include "core/sample_spectrum.h"
#include "integrator/path_start.h"
#include "spectral/illuminants.h"
#include "spectral/rgb_table.h"

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

/// Sixteen paths' wavelengths, with observer and emission there.
template <int N>
void draw(benchmark::State& state, const WavelengthSampler& sampler) {
  const TabulatedSpectrum lamp = fluorescent_lamp();
  const CompiledSampler compiled(sampler, Observer::cie1931(), std::span(&lamp, 1));
  UintLanes bits;
  for (int i = 0; i < kLanes; ++i) bits[i] = static_cast<std::uint32_t>(i) * 0x10000000u;
  for (auto _ : state) {
    bits += 0x9e3779b9u;  // the golden ratio: every stratum alike
    auto w = compiled.draw<N>(bits);
    auto values = compiled.look_up(w, 0);
    benchmark::DoNotOptimize(w);
    benchmark::DoNotOptimize(values);
  }
  state.SetItemsProcessed(state.iterations() * kLanes);
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
const bool added_draws = add_draws<1>() && add_draws<4>() && add_draws<8>() && add_draws<16>();

SampleStream stream(benchmark::State& state, std::uint32_t sample) {
  return {static_cast<Sequence>(state.range(0)), 7, 1234, sample};
}

void get_1d(benchmark::State& state) {
  std::uint32_t i = 0;
  for (auto _ : state) {
    ++i;
    benchmark::DoNotOptimize(stream(state, i).get_1d(i & 63));
  }
}
void get_2d(benchmark::State& state) {
  std::uint32_t i = 0;
  for (auto _ : state) {
    ++i;
    Sample2d u = stream(state, i).get_2d(i & 63);
    benchmark::DoNotOptimize(u);
  }
}
BENCHMARK(get_1d)->Arg(static_cast<int>(Sequence::sobol))->Arg(static_cast<int>(Sequence::independent));
BENCHMARK(get_2d)->Arg(static_cast<int>(Sequence::sobol))->Arg(static_cast<int>(Sequence::independent));

void leave_camera(benchmark::State& state) {
  Camera camera;
  camera.width = camera.height = 256;
  std::uint32_t i = 0;
  for (auto _ : state) {
    ++i;
    Ray ray = camera_ray(camera, i & 0xffff, SampleStream(Sequence::sobol, 1, i, i));
    benchmark::DoNotOptimize(ray);
  }
}
BENCHMARK(leave_camera);

template <int N>
void at_wavelengths(benchmark::State& state, const Spectrum& spectrum) {
  SampledSpectrum<N> lambda;
  for (int j = 0; j < N; ++j) lambda.v[j] = 380.0f + 400.0f * (static_cast<float>(j) + 0.5f) / N;
  for (auto _ : state) {
    benchmark::DoNotOptimize(lambda);
    SampledSpectrum<N> value = sample_spectrum<N>(spectrum, lambda);
    benchmark::DoNotOptimize(value);
  }
}

template <int N>
bool add_spectra() {
  const std::string width = "/" + std::to_string(N);
  const Spectrum sigmoid = upsample_reflectance({0.2, 0.5, 0.7});
  const Spectrum table = tabulate_emission(*cie_illuminant("FL11"));
  benchmark::RegisterBenchmark(("at_wavelengths/sigmoid" + width).c_str(), at_wavelengths<N>, sigmoid);
  benchmark::RegisterBenchmark(("at_wavelengths/table" + width).c_str(), at_wavelengths<N>, table);
  return true;
}
const bool added = add_spectra<4>() && add_spectra<8>() && add_spectra<16>();

void table_of_rgb(benchmark::State& state) {
  std::uint32_t i = 0;
  for (auto _ : state) {
    const std::uint32_t bits = mix_bits(++i);
    const auto channel = [&](int shift) { return static_cast<float>(bits >> shift & 255u) / 255.0f; };
    SigmoidPolynomial reflectance = tabulated_reflectance(channel(0), channel(8), channel(16));
    benchmark::DoNotOptimize(reflectance);
  }
}
BENCHMARK(table_of_rgb);

/// Sixteen at once.
/// @param state range(0): the distance in sides of the light; near ones are sampled by solid angle
void sample_area_light(benchmark::State& state) {
  AreaLight light{};
  light.edge1 = {1, 0, 0}, light.edge2 = {0, 1, 0}, light.normal = {0, 0, 1};
  light.area = 1, light.parallelogram = true;
  const AreaLightLanes lights(light);
  const SampleStreamLanes streams(Sequence::sobol, UintLanes{} + 1u, UintLanes{} + 2u, UintLanes{});
  std::uint32_t i = 0;
  for (auto _ : state) {
    const Sample2dLanes u = streams.get_2d(++i);
    LightSampleLanes samples;
    lights.sample({u.x, u.y, Lanes{} + static_cast<float>(state.range(0))}, u, samples);
    benchmark::DoNotOptimize(samples);
  }
  state.SetItemsProcessed(state.iterations() * kLanes);
}
BENCHMARK(sample_area_light)->Arg(1)->Arg(10);

void add_to_film(benchmark::State& state) {
  Film film(256, 256);
  std::size_t i = 0;
  for (auto _ : state) film.add(++i & 0xffff, {0.1, 0.2, 0.3});
  benchmark::DoNotOptimize(film.image_mean());
}
BENCHMARK(add_to_film);

}  // namespace
}  // namespace photopic
