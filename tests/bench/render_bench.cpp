// Whole renders of a box with a lamp in it: what batches are worth, and what each sampler costs.
#include <benchmark/benchmark.h>

#include "integrator/integrator.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

/// Adds the parallelogram of `corner`, `corner + a`, `corner + a + b`, `corner + b`; its front is where a × b
/// points.
void add_parallelogram(Scene& scene, Vec3f corner, Vec3f a, Vec3f b, std::uint32_t material) {
  Geometry& g = scene.geometry;
  const auto first = static_cast<std::uint32_t>(g.positions.size());
  for (Vec3f p : {corner, corner + a, corner + a + b, corner + b}) {
    g.positions.push_back(p);
    g.normals.push_back({});
  }
  g.shapes.push_back({static_cast<std::uint32_t>(g.triangles.size()), 2, material});
  g.triangles.push_back({first, first + 1, first + 2});
  g.triangles.push_back({first, first + 2, first + 3});
}

Material diffuse(Rgb color) {
  Material material;
  material.base_color = upsample_reflectance(color);
  material.metallic = 0;
  material.double_sided = true;
  return material;
}

Scene box() {
  Scene scene;
  const TabulatedSpectrum lamp = tabulate_emission(*cie_illuminant("FL11"));
  scene.emission_spectra = {lamp.scaled(1.0 / emission_xyz(lamp, Observer::cie1931()).y)};
  scene.emission_names = {"cie:FL11"};
  scene.materials = {diffuse({0.7, 0.7, 0.7}), diffuse({0.6, 0.05, 0.05}), diffuse({0.1, 0.5, 0.1}),
                     diffuse({0, 0, 0})};
  scene.materials[3].emission_spectrum = 0;
  scene.materials[3].emission_luminance = 15;
  add_parallelogram(scene, {-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, 0);                 // floor
  add_parallelogram(scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 0);                  // ceiling
  add_parallelogram(scene, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 0);                 // back
  add_parallelogram(scene, {-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, 1);                 // left
  add_parallelogram(scene, {1, -1, -1}, {0, 0, 2}, {0, 2, 0}, 2);                  // right
  add_parallelogram(scene, {-0.3f, 0.99f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, 3);  // lamp
  scene.camera.position = {0, 0, 3.5f};
  scene.camera.tan_half_yfov = 0.4f;
  scene.camera.width = scene.camera.height = 64;
  return scene;
}

void render_box(benchmark::State& state, const WavelengthSampler& sampler) {
  const PreparedScene scene(box());
  const RenderOptions options{.spp = 4, .batch_size = static_cast<int>(state.range(0))};
  std::uint64_t paths = 0;
  for (auto _ : state) paths += render(scene, sampler, options).stats.paths;
  state.SetItemsProcessed(static_cast<std::int64_t>(paths));
}
BENCHMARK_CAPTURE(render_box, uniform, UniformWavelengths{4})->Arg(1)->Arg(1024)->UseRealTime();
BENCHMARK_CAPTURE(render_box, visible, VisibleWavelengths{4})->Arg(1)->Arg(1024)->UseRealTime();

}  // namespace
}  // namespace photopic
