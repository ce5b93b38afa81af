#include <cmath>
#include <numbers>

#include "furnace.h"
#include "stress_case.h"

namespace photopic::test {
namespace {

constexpr double kPiD = std::numbers::pi;

/// The floor at the world's zero, seen through a pinhole of a view.
SceneBuilder floor_scene(double albedo) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{albedo})));
  b.camera({-1, 0, 1}, {0, 0, 0}, 0.02, 8, 8);
  return b;
}

/// From starlight to lasers.
void add_luminances(StressList& list) {
  for (const double l : list.decades(-8, 12)) {
    SceneBuilder b = floor_scene(0.5);
    b.ceiling({0, 0, 10}, 0.1, 0.1, b.lamp(d65(), l));
    list.add({"luminance", with_number("floor under a lamp of", l) + " cd/m²", built(b),
              Luminance{0.5 * l * 0.04 / 100 / kPiD, 3e-4}, 300, 2});
    list.add({"luminance", with_number("glass in a furnace of", l) + " cd/m²",
              built(furnace(solid_glass(1.5f, 0.0f), l)), Luminance{l, 2e-4}, 60, 300});
    // Beside it another, dim or bright: chosen by what each may add.
    b.ceiling({0.5, 0, 10}, 0.1, 0.1, b.lamp(fl11(), 1.0));
    const double d2 = 100.25, dim = 0.04 * (100 / d2) / d2;
    list.add({"luminance", with_number("lamp of 1 cd/m² beside one of", l), built(b),
              Luminance{0.5 * (l * 0.04 / 100 + dim) / kPiD, 3e-4}, 500, 2});
  }
}

void add_sizes(StressList& list) {
  for (const double half : list.steps({1e3, 1e7}, {1e2, 1e3, 1e4, 1e5, 1e6, 1e7})) {
    SceneBuilder b = floor_scene(0.5);  // an endless lamp overhead: irradiance π·L
    b.ceiling({0, 0, 1.5}, half, half, b.lamp(d65(), 2.0));
    list.add({"size of lamps", with_number("half a side of", half) + " m", built(b), Luminance{1.0, 1e-3},
              2000, 2});
  }
  for (const double half : list.steps({1e-3, 1e-7}, {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8})) {
    SceneBuilder b = floor_scene(0.5);
    b.ceiling({0, 0, 3}, half, half, b.lamp(d65(), 100 * 9.0 / (4 * half * half)));
    list.add({"size of lamps", with_number("half a side of", half) + " m", built(b),
              Luminance{50 / kPiD, half >= 0.1 ? 2e-3 : 3e-4}, 500, 2});
  }
}

/// A wall that shines and stands on the floor: from a point `c` away a half wall of width b and height a
/// fills this share of the sky's projected solid angle (Siegel & Howell, configuration factor B-4).
double wall_factor(double a, double b, double c) {
  const double x = a / b, y = c / b, r = std::sqrt(x * x + y * y);
  return (std::atan(1 / y) - y / r * std::atan(1 / r)) / (2 * kPiD);
}

/// Lamps that touch what they light.
void add_touching(StressList& list) {
  for (const double c : list.steps({1, 1e-2, 1e-4}, {1, 0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5})) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{0.5})));
    const auto lamp = b.lamp(d65(), 4.0);
    b.quad({0, -1, 0}, {0, -1, 0.7}, {0, 1, 0.7}, {0, 1, 0}, lamp);
    b.camera({-c - 1, 0, 1}, {-c, 0, 0}, std::min(0.02, 2 * c), 8, 8);
    list.add({"touching lamps", with_number("shining wall on the floor, seen from", c) + " m", built(b),
              Luminance{0.5 * 4 * 2 * wall_factor(0.7, 1, c), 5e-4}, 3000, 2});
  }
  for (const double x :
       list.steps({0.1, 3, 100}, {0.1, 0.3, 1, 3, 10, 100, 1000})) {  // from the point where they touch
    SceneBuilder b;
    b.floor({0, 0, 0}, 5 + 2 * x, 5 + 2 * x, b.material(diffuse(ConstantSpectrum{0.5})));
    b.sphere({0, 0, 0.5}, 0.5, 5, b.lamp(d65(), 4.0), false);
    b.camera({-x - 1, 0, std::min(2 * x, 1.0)}, {-x, 0, 0}, 0.02, 8, 8);  // under the ball
    const double d2 = x * x + 0.25;
    list.add({"touching lamps", with_number("shining ball on the floor, seen from", x) + " m", built(b),
              Luminance{0.5 * 4 * 0.125 / (d2 * std::sqrt(d2)), 1e-3}, 3000, 2});
  }
  for (const double gap : list.steps({1e-5}, {1e-5, 1e-4, 1e-3})) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{0.5})));
    b.floor({0, 0, gap}, 0.5, 0.5, b.lamp(d65(), 4.0));
    b.camera({-1, 0.2, 1}, {0, 0, 0}, 10, 8, 8);
    list.add({"touching lamps", with_number("lamp laid on the floor, gap", gap), built(b), Luminance{4.0},
              500, 4});
  }
}

/// Lines of a hundredth of a nanometre, by themselves and beside daylight.
void add_lines(StressList& list) {
  for (const double width : list.steps({10, 0.01, 1e-5}, {10, 1, 0.1, 0.01, 1e-3, 1e-4, 1e-5})) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 1, 1, b.lamp(LineSpectrum{532, width}, 6.0));
    b.camera({0, 0, 1}, {0, 0, 0}, 30, 8, 8);
    list.add({"lines", with_number("line fills the view, width", width) + " nm", built(b),
              Luminance{6.0, 1e-3}, 1000, 1});
  }
  const std::vector<Spectrum> lamps{LineSpectrum{532, 0.01}, LineSpectrum{633, 0.01},
                                    LineSpectrum{436, 0.001}, d65()};
  SceneBuilder b = floor_scene(0.5);
  double irradiance = 0.0;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const double x = 0.1 * (static_cast<double>(i) - 1.5), d2 = 400.0 + x * x;
    b.ceiling({x, 0, 20}, 0.04, 0.04, b.lamp(lamps[i], 1e5));
    irradiance += 1e5 * 0.0064 * (400.0 / d2) / d2;  // L·A·cos²/d²
  }
  StressCase c{"lines",  "three lines and daylight, by the illuminant",
               built(b), Luminance{0.5 * irradiance / kPiD, 1e-3},
               2000,     2};
  list.add(c);
  c.name = "three lines and daylight, by other densities";
  c.sampler = [](const TabulatedSpectrum& emission) { return arbitrary_distribution(emission, 4); };
  list.add(c);
}

/// Nothing shines, or there is nothing at all.
void add_darkness(StressList& list) {
  list.add({"darkness", "floor without a lamp", built(floor_scene(0.5)), Dark{}, 10, 12});
  SceneBuilder nothing;
  nothing.camera({0, 0, 0}, {1, 0, 0}, 40, 4, 4);
  list.add({"darkness", "empty scene", built(nothing), Dark{}, 10, 12});
}

}  // namespace

void add_light_cases(StressList& list) {
  add_luminances(list);
  add_sizes(list);
  add_touching(list);
  add_lines(list);
  add_darkness(list);
}

}  // namespace photopic::test
