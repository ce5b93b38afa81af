#include "stress_case.h"

namespace photopic::test {
namespace {

/// A lamp cast into a block of glass, `depth` below the face that the camera looks at.
SceneBuilder cast_lamp(double ior, double depth) {
  SceneBuilder b;
  b.box({-5, -5, -5}, {5, 5, 0}, b.material(solid_glass(static_cast<float>(ior), 0.0f)));
  b.floor({0, 0, -depth}, 4, 4, b.lamp(d65(), 5.0));
  b.camera({0, 0, 1}, {0, 0, 0}, 0.05, 8, 8);
  return b;
}

/// A block of glass, 1 m high, that stands on a lamp.
SceneBuilder block_on_lamp(double gap) {
  SceneBuilder b;
  b.box({-5, -5, 0}, {5, 5, 1}, b.material(solid_glass(1.5f, 0.0f)));
  b.floor({0, 0, -gap}, 4, 4, b.lamp(d65(), 5.0));
  b.camera({0, 0, 2}, {0, 0, 0}, 0.05, 8, 8);
  return b;
}

/// A lamp and a painted ball in a block of tinted glass.
Scene filled_block(float roughness, double lamp_half) {
  SceneBuilder b;
  Material glass = solid_glass(1.3f, roughness);
  glass.attenuation_color = upsample_reflectance({0.7, 0.3, 0.1});
  glass.attenuation_distance = 0.5f;
  b.box({-1, -1, -1}, {1, 1, 1}, b.material(glass));
  b.box({-0.5 - lamp_half, -lamp_half, -lamp_half}, {-0.5 + lamp_half, lamp_half, lamp_half},
        b.lamp(d65(), 5.0));
  b.sphere({0.5, 0, 0}, 0.4, 2, b.material(diffuse(ConstantSpectrum{0.8})));
  b.floor({0, 0, -1.001}, 3, 3, b.material(diffuse(ConstantSpectrum{0.5})));
  b.camera({0.5, -3, 1}, {0, 0, 0}, 40, 12, 12);
  return b.build();
}

}  // namespace

/// Lamps inside glass. Radiance that leaves it falls by the square of the index and by what the face reflects
/// (a lamp reflects nothing back).
void add_glass_lamp_cases(StressList& list) {
  for (const double ior : list.steps({1, 1.5, 4}, {1, 1 + 1e-6, 1.1, 1.33, 1.5, 2, 3, 4}))
    for (const double depth : list.steps({1e-2}, {1e-5, 1e-4, 1e-2, 1})) {
      const double f = ior == 1 ? 0.0 : fresnel(1.0, ior);
      list.add({"lamps in glass", with_number(with_number("index", ior) + ", below the face by", depth),
                built(cast_lamp(ior, depth)), Luminance{5 * (1 - f) / (ior * ior), 1e-3}, 500, 8});
    }
  // One that touches is as if cast in; one beyond a gap shines through two faces, whose reflections add up.
  const double f = fresnel(1.0, 1.5);
  for (const double gap : list.steps({0, 1e-3}, {0, 1e-9, 1e-7, 1e-5, 1e-3}))
    list.add({"lamps in glass", with_number("glass on a lamp, gap", gap), built(block_on_lamp(gap)),
              Luminance{gap < 1e-6 ? 5 * (1 - f) / 2.25 : 5 * (1 - f) / (1 + f), 1e-3}, 1000, 30});
  list.add({"lamps in glass", "flush with the face", built(cast_lamp(1.5, 0)), Luminance{5}, 10, 8});
  const bool full = list.form() == Form::full;
  for (const float roughness : {0.0f, 0.5f}) {
    const auto oracle = std::make_shared<Reference>("as the oracle sees it", [=] {
      return render_oracle(filled_block(roughness, 0.3), full ? 4000 : 600, 8);
    });
    StressCase c{"lamps in glass",
                 with_number("lamp and ball in a tinted block, roughness", roughness),
                 [=] { return filled_block(roughness, 0.3); },
                 oracle,
                 500,
                 8};
    list.add(c);
  }
}

}  // namespace photopic::test
