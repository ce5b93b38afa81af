#include "support/standard_scenes.h"

#include "spectral/illuminants.h"

namespace photopic::test {
namespace {

Spectrum rgb(double r, double g, double b) {
  return upsample_reflectance({r, g, b});
}

}  // namespace

Spectrum fl11() {
  return cie_illuminant("FL11").value();
}
Spectrum d65() {
  return cie_illuminant("D65").value();
}

SceneBuilder lamp_room(const Spectrum& lamp, int resolution) {
  SceneBuilder b;
  const auto white = b.material(diffuse(ConstantSpectrum{0.7}));
  const auto red = b.material(diffuse(rgb(0.6, 0.1, 0.05)));
  const auto green = b.material(diffuse(rgb(0.1, 0.45, 0.1)));
  b.floor({0, 0, 0}, 1, 1, white);
  b.ceiling({0, 0, 2}, 1, 1, white);
  b.quad({-1, -1, 0}, {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2}, red);
  b.quad({1, 1, 0}, {1, -1, 0}, {1, -1, 2}, {1, 1, 2}, green);
  b.quad({1, -1, 0}, {-1, -1, 0}, {-1, -1, 2}, {1, -1, 2}, white);
  b.quad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2}, white);
  b.ceiling({0, 0, 1.95}, 0.9, 0.9, b.lamp(lamp, 10.0));
  b.camera({0, -0.98, 1.0}, {0, 1, 0.8}, 75, resolution, resolution);
  return b;
}

SceneBuilder diffuse_room(int resolution) {
  SceneBuilder b = lamp_room(fl11(), resolution);
  Material glowing = diffuse(rgb(0.15, 0.2, 0.7));  // a second lamp, of another spectrum
  glowing.emission_spectrum = b.emission(BlackbodySpectrum{2700});
  glowing.emission_luminance = 0.5f;
  b.box({-0.7, 0.1, 0}, {-0.2, 0.5, 1.1}, b.material(glowing));
  b.sphere({0.4, 0, 0.4}, 0.4, 2, b.material(diffuse(ConstantSpectrum{0.5})));
  return b;
}

SceneBuilder glossy_room(int resolution) {
  SceneBuilder b = lamp_room(d65(), resolution);
  b.box({-0.7, 0.1, 0}, {-0.2, 0.5, 1.1}, b.material(metal(rgb(0.9, 0.6, 0.3), 0.3f)));
  b.sphere({0.45, 0, 0.4}, 0.4, 2, b.material(plastic(rgb(0.2, 0.3, 0.7), 0.2f)));
  b.box({-0.3, -0.6, 0}, {0.1, -0.3, 0.3}, b.material(metal(ConstantSpectrum{0.9}, 0.0f)));
  Material mixed = plastic(rgb(0.5, 0.5, 0.1), 0.6f);
  mixed.metallic = 0.5f;
  b.sphere({0.1, 0.6, 1.2}, 0.25, 2, b.material(mixed));
  b.quad({-0.9, 0.6, 1.2}, {-0.4, 0.4, 1.3}, {-0.4, 0.4, 1.7}, {-0.9, 0.6, 1.7}, b.lamp(fl11(), 3.0, true));
  return b;
}

SceneBuilder glass_room(int resolution) {
  SceneBuilder b = lamp_room(fl11(), resolution);
  Material tinted = solid_glass(1.5f, 0.0f);
  tinted.attenuation_color = rgb(0.3, 0.8, 0.6);
  tinted.attenuation_distance = 0.5f;
  b.sphere({-0.45, 0.2, 0.5}, 0.4, 2, b.material(tinted));
  tinted.ior = 1.33f, tinted.roughness = 0.4f;
  b.sphere({0.45, 0, 0.5}, 0.4, 2, b.material(tinted));
  Material pane = thin_glass(1.5f, 0.2f);
  pane.base_color = rgb(0.8, 0.8, 0.5);
  pane.transmission = 0.8f;
  b.quad({-0.5, -0.4, 0.1}, {0.3, -0.5, 0.1}, {0.3, -0.5, 0.5}, {-0.5, -0.4, 0.5}, b.material(pane));
  return b;
}

WavelengthSampler arbitrary_distribution(const TabulatedSpectrum& emission, int count) {
  WavelengthDistribution d{base_density(emission), {}, "arbitrary", "", ""};
  for (int k = 0; k < count; ++k) {
    WavelengthDistribution::Component c;
    for (int i = 0; i < 12; ++i) c.nodes.push_back(0.2 + (i * 7 + k * 5) % 11);
    c.backwards = k % 2 == 1;
    d.components.push_back(c);
  }
  return OptimizedWavelengths(d);
}

std::vector<WavelengthSampler> all_samplers(const TabulatedSpectrum& emission, int count) {
  return {UniformWavelengths{count}, VisibleWavelengths{count},
          IlluminantWavelengths{count, base_density(emission)}, arbitrary_distribution(emission, count)};
}

}  // namespace photopic::test
