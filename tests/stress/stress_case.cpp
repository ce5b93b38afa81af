#include "stress_case.h"

#include <cmath>
#include <cstdio>

namespace photopic::test {
namespace {

constexpr int kFullSamples = 6;  ///< times as many as in the short form
constexpr double kFamily = 0.01;

WavelengthSampler sampler_of(const StressCase& c, const PreparedScene& scene) {
  if (scene.lights.empty()) return UniformWavelengths{4};
  const TabulatedSpectrum emission = scene_emission(scene);
  return c.sampler ? c.sampler(emission) : IlluminantWavelengths{4, base_density(emission)};
}

RenderOptions options_of(int spp, int max_depth, std::uint32_t seed) {
  return {.spp = spp, .sequence = Sequence::independent, .seed = seed, .max_depth = max_depth};
}

/// A number of its own for each case (FNV-1a of the name), so that their errors are independent.
std::uint32_t seed_of(const StressCase& c) {
  std::uint32_t hash = 2166136261u;
  for (const char letter : c.topic + c.name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
  return hash;
}

std::size_t pixels(const Film& film) {
  return static_cast<std::size_t>(film.width()) * static_cast<std::size_t>(film.height());
}

void judge(const Luminance& expected, const StressCase& c, const Film&, Outcome& o) {
  o.expected = with_number("", expected.value);
  o.z = z_score(o.measured, {expected.value, expected.tolerance * std::abs(expected.value)});
  if (o.measured.error > c.largest_error * std::abs(expected.value)) o.problem = "too noisy to tell";
}

void judge(const Dark&, const StressCase&, const Film& film, Outcome& o) {
  o.expected = "dark";
  o.leaks = 0;
  for (std::size_t i = 0; i < pixels(film); ++i) *o.leaks += film.mean(i).y != 0.0;
  if (*o.leaks > 0) o.problem = "light leaks in";
}

void judge(const SameAs& expected, const StressCase& c, const Film& film, Outcome& o) {
  const std::vector<Estimate> a = quarter_estimates(film), b = quarter_estimates(expected->film());
  o.expected = expected->name();
  o.z = largest_z(a, b);
  o.tests = a.size();
  if (o.measured.error > c.largest_error * o.measured.mean) o.problem = "too noisy to tell";
}

}  // namespace

RenderResult render_case(const StressCase& c, int spp, std::uint32_t seed) {
  const PreparedScene scene(c.scene());
  return render(scene, sampler_of(c, scene), options_of(spp, c.max_depth, seed));
}

Film render_reference(const Scene& source, int spp, int max_depth) {
  const PreparedScene scene(source);
  return render(scene, sampler_of({}, scene), options_of(spp, max_depth, 99)).film;
}

Film render_oracle(const Scene& source, int spp, int max_depth) {
  const PreparedScene scene(source);
  return render_naive(scene, sampler_of({}, scene), options_of(spp, max_depth, 98)).film;
}

Outcome measure(const StressCase& c, Form form, std::size_t tests) {
  RenderResult r = render_case(c, form == Form::brief ? c.spp : kFullSamples * c.spp, seed_of(c));
  Outcome o;
  o.stats = r.stats;
  o.measured = image_estimates(r.film)[1];
  std::visit([&](const auto& expected) { judge(expected, c, r.film, o); }, c.expectation);
  if (!(std::abs(o.z) < normal_threshold(sidak_significance(kFamily, tests)))) o.problem = "z is too large";
  if (c.brightest_pixel > 0.0)
    for (std::size_t i = 0; i < pixels(r.film); ++i)
      if (r.film.mean(i).y > c.brightest_pixel) o.problem = with_number("firefly of", r.film.mean(i).y);
  if (r.stats.non_finite > 0) o.problem = "samples are not finite";
  return o;
}

std::size_t count_tests(const StressList& list) {
  std::size_t count = 0;
  for (const StressCase& c : list.cases()) count += std::holds_alternative<SameAs>(c.expectation) ? 15 : 1;
  return count;
}

std::vector<double> StressList::decades(int low, int high) const {
  std::vector<double> all;
  for (int i = low; i <= high; ++i) all.push_back(std::pow(10.0, i));
  return form_ == Form::full ? all : std::vector{all.front(), all[all.size() / 2], all.back()};
}

StressList stress_list(Form form) {
  StressList list(form);
  add_scale_cases(list);
  add_view_cases(list);
  add_geometry_cases(list);
  add_coincidence_cases(list);
  add_leak_cases(list);
  add_shadow_cases(list);
  add_instance_cases(list);
  add_roughness_cases(list);
  add_material_cases(list);
  add_light_cases(list);
  add_glass_lamp_cases(list);
  return list;
}

std::function<Scene()> built(SceneBuilder builder) {
  return [builder = std::move(builder)] { return builder.build(); };
}

double fresnel(double cos_i, double n) {
  const double cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (n * n));
  const double parallel = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  const double perpendicular = (cos_i - n * cos_t) / (cos_i + n * cos_t);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

std::string with_number(const std::string& name, double x) {
  char number[32];
  std::snprintf(number, sizeof number, "%.8g", x);
  return name.empty() ? number : name + " " + number;
}

}  // namespace photopic::test
