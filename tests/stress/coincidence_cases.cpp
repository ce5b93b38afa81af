#include <cmath>
#include <numbers>

#include "stress_case.h"

namespace photopic::test {
namespace {

constexpr double kPiD = std::numbers::pi;

/// A floor of two sheets, `gap` apart, below 100 lx.
SceneBuilder two_floors(double gap, double upper, double lower) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 1, 1, b.material(diffuse(ConstantSpectrum{upper})));
  b.floor({0.01, 0.02, -gap}, 1, 1, b.material(diffuse(ConstantSpectrum{lower})));
  b.ceiling({0, 0, 100}, 0.5, 0.5, b.lamp(d65(), 1e6));
  b.camera({-1, 0.3, 1}, {0.05, 0.07, 0}, 5, 8, 8);
  return b;
}

/// A furnace of 3 cd/m² with white and clear things that touch one another.
SceneBuilder touching(const Material& material, double gap) {
  SceneBuilder b;
  b.box({-2, -2, -1}, {2, 2, 3}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.floor({0, 0, gap}, 1, 1, b.material(diffuse(ConstantSpectrum{1.0})));
  const auto m = b.material(material);
  b.box({-0.5, -0.5, 2 * gap}, {0, 0.5, 0.4}, m);
  b.box({gap, -0.5, 2 * gap}, {0.5, 0.5, 0.4}, m);
  b.box({-0.3, -0.3, 0.4 + gap}, {0.3, 0.3, 0.7}, m);
  b.camera({0.9, -1.3, 1.2}, {0, 0, 0.3}, 40, 8, 8);
  return b;
}

/// A furnace of 3 cd/m² with glasses of several kinds and sizes side by side, or each within the one before
/// and flush with it on three sides; the second is there twice.
SceneBuilder row(double gap, bool nested) {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  Material flint = solid_glass(1.7f, 0.0f);
  flint.extensions.dispersion = glass_index("SF11");
  const auto glass = [](float ior) { return solid_glass(ior, 0.0f); };
  double x = -0.7, size = 0.4;
  const auto place = [&](const Material& m) {
    if (nested)
      b.box({x, x, x}, {size, 0.4, size}, b.material(m));
    else
      b.box({x, -0.4, -size}, {x + 0.3, 0.4, size}, b.material(m));
  };
  for (const Material& m : {flint, glass(1.33f), glass(1.31f), glass(1.5f)}) {
    place(m);
    if (m.ior == 1.33f) place(m);
    x += nested ? gap : 0.3 + gap;
    size -= nested ? gap : 0.05;
  }
  b.camera({0.7, -1.8, 1.1}, {-0.1, 0, 0}, 40, 8, 8);
  return b;
}

/// A stack of panes in a furnace.
SceneBuilder stack(double gap) {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 3}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  const auto pane = b.material(thin_glass(1.5f, 0.0f));
  for (int i = 0; i < 6; ++i) b.floor({0, 0, i * gap}, 1, 1, pane);
  b.camera({0.5, -0.8, 1.2}, {0, 0, 0}, 40, 8, 8);
  return b;
}

/// A dark room and a bright one, with their own walls a gap apart.
SceneBuilder neighbours(double gap, double bright) {
  SceneBuilder b;
  b.box({-1, -1, -1}, {1, 1, 1}, b.material(diffuse(ConstantSpectrum{0.9})), true);
  b.box({1 + gap, -1, -1}, {3, 1, 1}, b.lamp(d65(), bright), true);
  b.camera({-0.5, 0, 0}, {1, 0.2, 0.1}, 100, 8, 8);
  return b;
}

/// The floor of a gap of height h whose ceiling shines.
SceneBuilder low_ceiling(double h) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 1, 1, b.material(diffuse(ConstantSpectrum{0.5})));
  b.ceiling({0, 0, h}, 1, 1, b.lamp(d65(), 4.0));
  b.camera({-0.8 * h, 0.1 * h, 0.6 * h}, {0, 0, 0}, 10, 8, 8);
  return b;
}

/// The share of the projected sky that a square of half a side x fills, one above its middle (Siegel &
/// Howell, configuration factor B-3, four times).
double overhead(double x) {
  const double r = std::sqrt(1 + x * x);
  return 4 / kPiD * x / r * std::atan(x / r);
}

}  // namespace

/// Surfaces in one place, or nearly: coordinates of 1 m are known to about 1e-6 m.
void add_coincidence_cases(StressList& list) {
  for (const double gap :
       list.steps({0, 1e-6, 1e-3}, {0, 1e-8, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3, 1e-2}))
    list.add({"coincident", with_number("two floors, gap", gap), built(two_floors(gap, 0.5, 0.5)),
              Luminance{50 / kPiD, 1e-3}, 300, 2});
  for (const double gap : list.steps({1e-5}, {3e-6, 1e-5, 1e-4, 1e-3}))
    list.add({"coincident", with_number("white over black, gap", gap), built(two_floors(gap, 0.8, 0.0)),
              Luminance{80 / kPiD, 1e-3}, 300, 2});

  for (const double gap : list.steps({0, 1e-5}, {0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3})) {
    list.add({"coincident", with_number("touching boxes of white paint, gap", gap),
              built(touching(diffuse(ConstantSpectrum{1.0}), gap)), Luminance{3.0, 3e-4}, 60, 300});
    list.add(
        {"coincident", with_number("stack of panes, gap", gap), built(stack(gap)), Luminance{3.0}, 60, 500});
    list.add({"coincident", with_number("dark room beside a bright one, gap", gap),
              built(neighbours(gap, 1e6)), Dark{}, 60, 20});
  }
  for (const double gap : list.steps({0, 8e-7, 1e-5}, {0, 1e-9, 1e-8, 1e-7, 3e-7, 5e-7, 8e-7, 1e-6, 1.2e-6,
                                                       1.6e-6, 2e-6, 3e-6, 1e-5, 1e-4, 1e-3})) {
    for (const double roughness : {0.0, 0.4})
      list.add({"coincident",
                with_number(with_number("touching boxes of glass of roughness", roughness) + ", gap", gap),
                built(touching(solid_glass(1.5f, static_cast<float>(roughness)), gap)),
                Luminance{3.0, roughness > 0 ? 2e-3 : 3e-4}, 60, 500});
    for (const double turn : {0.0, 0.7}) {
      const std::string name = turn > 0 ? ", turned, gap" : ", gap";
      list.add({"coincident", with_number("flint, water, ice and crown in a row" + name, gap),
                built(row(gap, false).turn({1, 2, 3}, turn)), Luminance{3.0, 3e-4}, 60, 500});
      list.add({"coincident", with_number("shells of glass without room between" + name, gap),
                built(row(gap, true).turn({1, 2, 3}, turn)), Luminance{3.0, 3e-4}, 60, 500});
    }
  }
  for (const double size : list.steps({1e-4, 1e6}, {1e-4, 1e-2, 1, 1e2, 1e4, 1e6}))
    list.add({"coincident", with_number("touching cubes of glass, times", size),
              built(row(0, false).turn({1, 2, 3}, 0.7).place(size)), Luminance{3.0, 3e-4}, 60, 500});
  for (const double x : list.steps({1e3}, {1e2, 1e3, 1e4}))
    list.add({"coincident", with_number("touching cubes of glass at x", x),
              built(row(0, false).turn({1, 2, 3}, 0.7).place(1, {x, -x, x})), Luminance{3.0, 1e-3}, 60, 500});
  for (const double h : list.steps({1e-1, 1e-5}, {1e-1, 1e-2, 1e-3, 1e-4, 3e-5, 1e-5}))
    list.add({"coincident", with_number("floor under a shining ceiling, gap", h), built(low_ceiling(h)),
              Luminance{2 * overhead(1 / h), 5e-4}, 2000, 2});
}

}  // namespace photopic::test
