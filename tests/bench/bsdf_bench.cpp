// BSDFs as a path uses them: made for one direction, then evaluated towards a light, or sampled.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/bsdf/conductor_bsdf.h"
#include "core/bsdf/glass_bsdf.h"
#include "core/bsdf/layered_bsdf.h"
#include "core/bsdf/opaque_bsdf.h"
#include "core/bsdf/spectral_glass_bsdf.h"
#include "core/sample_sequence.h"
#include "integrator/vertex.h"

namespace photopic {
namespace {

Material paint() {
  Material material;
  material.base_color = upsample_reflectance({0.2, 0.5, 0.7});
  material.metallic = 0;
  material.roughness = 0.5f;
  return material;
}

Material coated() {
  Material material = paint();
  material.extensions.clearcoat = 0.8f;
  material.extensions.clearcoat_roughness = 0.1f;
  return material;
}

Material gold() {
  Material material = paint();
  material.extensions.conductor = conductor_index("Au");
  return material;
}

Material glass(float roughness) {
  Material material = paint();
  material.transmission = 1;
  material.thin_walled = false;
  material.roughness = roughness;
  return material;
}

Material dispersive_glass() {
  Material material = glass(0);
  material.extensions.dispersion = abbe_index(1.5, 0.5);
  return material;
}

template <int N>
SampledSpectrum<N> path_wavelengths() {
  SampledSpectrum<N> lambda;
  for (int j = 0; j < N; ++j) lambda.v[j] = 380.0f + 400.0f * (static_cast<float>(j) + 0.5f) / N;
  return lambda;
}

template <template <int> typename Bsdf, int N>
struct Fixture {
  explicit Fixture(const Material& material) : surface(material) { prepare_albedos({true}, {&surface, 1}); }

  Bsdf<N> make(Vec3f wo) const {
    return make_bsdf<Bsdf<N>>(ShadingMaterial<N>(surface, lambda), wo, SampledSpectrum<N>(1.0f), [] {
      return Vec3f{0, 0, 1};
    });
  }
  /// A direction in the upper half, another each time.
  Vec3f next() {
    ++index;
    const SampleStream stream(Sequence::sobol, 1, 2, index);
    u = stream.get_2d(0), u_lobe = stream.get_1d(1);
    return sample_cosine_hemisphere(stream.get_2d(2));
  }

  Surface surface;
  SampledSpectrum<N> lambda = path_wavelengths<N>();
  std::uint32_t index = 0;
  Sample2d u{};
  float u_lobe = 0;
};

template <template <int> typename Bsdf, int N>
void evaluate_bsdf(benchmark::State& state, const Material& material) {
  Fixture<Bsdf, N> f(material);
  for (auto _ : state) {
    const Vec3f wo = f.next();
    BsdfValue<N> value = f.make(wo).evaluate(sample_cosine_hemisphere(f.u));
    benchmark::DoNotOptimize(value);
  }
}

template <template <int> typename Bsdf, int N>
void sample_bsdf(benchmark::State& state, const Material& material) {
  Fixture<Bsdf, N> f(material);
  for (auto _ : state) {
    const Vec3f wo = f.next();
    auto sample = f.make(wo).sample(f.u_lobe, f.u);
    benchmark::DoNotOptimize(sample);
  }
}

/// What next() costs of the others.
void directions_alone(benchmark::State& state) {
  Fixture<DiffuseBsdf, 4> f(paint());
  for (auto _ : state) {
    Vec3f wo = f.next();
    benchmark::DoNotOptimize(wo);
    benchmark::DoNotOptimize(f.u);
  }
}
BENCHMARK(directions_alone);

template <template <int> typename Bsdf, int N>
void add(const std::string& name, const Material& material) {
  const std::string ending = "/" + name + "/" + std::to_string(N);
  benchmark::RegisterBenchmark(("evaluate" + ending).c_str(), evaluate_bsdf<Bsdf, N>, material);
  benchmark::RegisterBenchmark(("sample" + ending).c_str(), sample_bsdf<Bsdf, N>, material);
}

template <template <int> typename Bsdf>
bool add_widths(const std::string& name, const Material& material) {
  add<Bsdf, 4>(name, material);
  add<Bsdf, 8>(name, material);
  add<Bsdf, 16>(name, material);
  return true;
}

const bool added =
    add_widths<DiffuseBsdf>("diffuse", paint()) && add_widths<OpaqueBsdf>("opaque", paint()) &&
    add_widths<ConductorBsdf>("conductor", gold()) && add_widths<LayeredBsdf>("layered", coated()) &&
    add_widths<GlassBsdf>("smooth glass", glass(0)) && add_widths<GlassBsdf>("rough glass", glass(0.55f)) &&
    add_widths<SpectralGlassBsdf>("dispersive glass", dispersive_glass());

}  // namespace
}  // namespace photopic
