#include "furnace.h"
#include "stress_case.h"

namespace photopic::test {
namespace {

/// White and clear things stay unseen in a furnace through the whole range of roughness, the change to a
/// mirror included. Rough glass is compensated from a table: half a percent.
void add_roughness(StressList& list, double step) {
  const auto roughness = static_cast<float>(step);
  const auto add = [&](const char* name, const Material& m, double tolerance, int max_depth) {
    StressCase c{"roughness", with_number(name, step), built(furnace(m)), Luminance{3.0, tolerance}, 60,
                 max_depth};
    list.add(c);
  };
  add("white metal", metal(ConstantSpectrum{1.0}, roughness), 2e-3, 12);
  add("white plastic", plastic(ConstantSpectrum{1.0}, roughness), 2e-3, 12);
  add("clear pane", thin_glass(1.5f, roughness), 2e-3, 200);
  add("clear glass", solid_glass(1.5f, roughness), 2e-3, 200);
}

/// An index of refraction between none and a semiconductor's.
void add_index(StressList& list, double ior) {
  const auto n = static_cast<float>(ior);
  const auto add = [&](const std::string& name, const Material& m, double tolerance, int spp, double noise) {
    StressCase c{
        "index", with_number(name + " of index", ior), built(furnace(m)), Luminance{3.0, tolerance}, spp,
        500};
    c.largest_error = noise;
    list.add(c);
  };
  add("clear glass", solid_glass(n, 0.0f), 2e-4, 60, 0.02);
  add("clear pane", thin_glass(n, 0.0f), 2e-4, 60, 0.02);
  add("white plastic", plastic(ConstantSpectrum{1.0}, 0.5f, n), 2e-3, 60, 0.02);
  // Where the index is high, radiance in the glass grows with its square, and so does the noise.
  for (const double roughness : {0.04, 0.2, 1.0}) {
    const bool noisy = ior > 2 && roughness > 0.5;
    if (noisy && list.form() == Form::brief) continue;
    add(with_number("glass of roughness", roughness) + ",", solid_glass(n, static_cast<float>(roughness)),
        2e-3, noisy ? 600 : 60, noisy ? 0.1 : 0.02);
  }

  // A slab over a lamp, polished: all orders of reflection sum up to (1 − F)/(1 + F).
  SceneBuilder b;
  b.floor({0, 0, -2}, 50, 50, b.lamp(fl11(), 5.0));
  b.box({-20, -20, -0.3}, {20, 20, 0}, b.material(solid_glass(n, 0.0f)));
  b.camera({0.8, 0, 0.6}, {0, 0, 0}, 0.02, 8, 8);
  const double f = ior == 1 ? 0.0 : fresnel(0.6, ior);
  list.add({"index", with_number("slab over a lamp, index", ior), built(b),
            Luminance{5 * (1 - f) / (1 + f), 5e-4}, 500, 100});
}

}  // namespace

void add_roughness_cases(StressList& list) {
  std::vector<double> steps{1e-6, 1e-3, 0.0316, 0.0317, 0.1, 0.25, 0.5, 0.75, 1.0};
  if (list.form() == Form::full) {
    for (int i = 0; i <= 50; ++i) steps.push_back(i / 50.0);
    for (const double fine : {0.005, 0.01, 0.025, 0.03, 0.0313, 0.032, 0.035}) steps.push_back(fine);
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  }
  for (const double step : steps) add_roughness(list, step);
  for (const double ior : list.steps(
           {1, 1 + 1e-6, 1.5, 4}, {1, 1 + 1e-6, 1.00005, 1.0002, 1.001, 1.01, 1.1, 1.33, 1.5, 2, 2.5, 3, 4}))
    add_index(list, ior);
}

}  // namespace photopic::test
