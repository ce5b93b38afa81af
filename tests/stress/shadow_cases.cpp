#include <cmath>
#include <numbers>

#include "stress_case.h"

namespace photopic::test {
namespace {

constexpr double kPiD = std::numbers::pi;

/// A white convex body in uniform light is as bright as the light: one shadow on itself and it is darker.
SceneBuilder white_ball(double size, Vec3d at, int levels) {
  SceneBuilder b;
  const double far = std::max(10 * size, 4 * max_abs(at));
  b.box({-far, -far, -far}, {far, far, far}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.sphere(at, size, levels, b.material(diffuse(ConstantSpectrum{1.0})), false);
  b.camera(at + Vec3d{2.5, 0.3, 0.5} * size, at, 22, 8, 8);
  return b;
}

/// A tiled floor under a small lamp that faces the spot seen, low above the horizon.
StressCase grazing_light(double elevation) {
  SceneBuilder b;
  const auto paint = b.material(diffuse(ConstantSpectrum{0.5}));
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y) b.floor({0.25 * x + 0.1, 0.25 * y + 0.1, 0}, 0.125, 0.125, paint);
  const double h = 5 * elevation, d2 = 25 + h * h, half = std::min(0.2 * h, 0.1);
  const Vec3d up = normalize(Vec3d{-elevation, 0, 1}) * half, side{0, half, 0}, c{5, 0, h};
  b.quad(c - up - side, c - up + side, c + up + side, c + up - side, b.lamp(d65(), 1e6, true));
  b.camera({-0.5, 0, 1}, {0, 0, 0}, 0.01, 8, 8);
  const double irradiance = 1e6 * 4 * half * half / d2 * (h / std::sqrt(d2));
  return {"grazing", with_number("light at a slope of", elevation),
          built(b),  Luminance{0.5 * irradiance / kPiD, 1e-3},
          500,       2};
}

/// Seen so a Lambertian floor keeps its radiance.
StressCase grazing_view(double elevation) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{0.5})));
  b.ceiling({0, 0, 1000}, 1, 1, b.lamp(d65(), 1e6));
  b.camera({1, 0, elevation}, {0, 0, 0}, 0.05 * elevation, 8, 8);
  return {"grazing", with_number("view at a slope of", elevation), built(b), Luminance{2 / kPiD, 5e-4}, 300,
          2};
}

/// What a polished surface of glass, or a black lacquer, mirrors of a shining wall: Fresnel's share.
StressCase grazing_mirror(double elevation, bool glass) {
  SceneBuilder b;
  const Material m = glass ? solid_glass(1.5f, 0.0f) : plastic(ConstantSpectrum{0.0}, 0.0f);
  b.floor({0, 0, 0}, 4, 4, b.material(m));
  b.quad({-3, -9, 0}, {-3, 9, 0}, {-3, 9, 9}, {-3, -9, 9}, b.lamp(d65(), 5.0));
  b.camera({1, 0, elevation}, {0, 0, 0}, 0.05 * elevation, 8, 8);
  const double cos_i = std::sin(std::atan(elevation));
  const double schlick = 0.04 + 0.96 * std::pow(1 - cos_i, 5);  // as glTF has it
  const double share = glass ? fresnel(cos_i, 1.5) : schlick;
  return {
      "grazing",
      with_number(std::string("mirror of ") + (glass ? "glass" : "lacquer") + " at a slope of", elevation),
      built(b),
      Luminance{5 * share, 1e-3},
      1000,
      2};
}

/// White, rough things in a furnace, seen nearly along the surface.
StressCase grazing_furnace(double elevation, double step, bool is_metal) {
  const auto roughness = static_cast<float>(step);
  SceneBuilder b;
  b.box({-4, -4, -4}, {4, 4, 4}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  const Material m =
      is_metal ? metal(ConstantSpectrum{1.0}, roughness) : plastic(ConstantSpectrum{1.0}, roughness);
  b.floor({0, 0, 0}, 2, 2, b.material(m));
  b.camera({1, 0, elevation}, {0, 0, 0}, 0.05 * elevation, 8, 8);
  const std::string name = std::string("white ") + (is_metal ? "metal" : "plastic") + " of roughness";
  return {"grazing", with_number(with_number(name, step) + " at a slope of", elevation), built(b),
          Luminance{3.0, 2e-3}, 300};
}

}  // namespace

void add_shadow_cases(StressList& list) {
  for (const double size :
       list.steps({1e-4, 1, 1e6}, {1e-4, 1e-3, 1e-2, 1e-1, 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}))
    for (const double levels : list.steps({1, 4}, {0, 1, 2, 3, 4, 5}))
      list.add({"self-shadowing", with_number(with_number("ball of", size) + " m, level", levels),
                built(white_ball(size, {}, static_cast<int>(levels))), Luminance{3.0, 2e-6}, 100, 3});
  for (const Vec3d& at : {Vec3d{1000, -1000, 1000}, Vec3d{300, 2, -10}, Vec3d{0.5, -1e4, 7}})
    list.add({"self-shadowing", with_number("ball of 1 m at y", at.y), built(white_ball(1, at, 3)),
              Luminance{3.0, 2e-6}, 100, 3});

  for (const double e : list.steps({1e-1, 1e-2, 1e-3}, {1, 0.3, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4})) {
    list.add(grazing_light(e));
    list.add(grazing_view(e));
    list.add(grazing_mirror(e, true));
    list.add(grazing_mirror(e, false));
    for (const double roughness : list.steps({0.1, 1}, {0, 0.1, 0.2, 0.4, 0.7, 1})) {
      list.add(grazing_furnace(e, roughness, true));
      list.add(grazing_furnace(e, roughness, false));
    }
  }
}

}  // namespace photopic::test
