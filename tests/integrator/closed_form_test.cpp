#include <gtest/gtest.h>

#include <numbers>

#include "core/bsdf/fresnel.h"
#include "core/bsdf/microfacet.h"
#include "integrator/integrator.h"
#include "spectral/observer.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

constexpr double kPiD = std::numbers::pi;

RenderOptions options(int spp, int max_depth) {
  return {.spp = spp, .sequence = Sequence::independent, .seed = 3, .max_depth = max_depth};
}

/// The image's mean XYZ against its expectation, in all channels, within the family's threshold.
void expect_xyz(const RenderResult& result, const Xyz& expected, std::size_t tests, const std::string& what,
                double tolerance = 2e-5) {
  const std::vector<Estimate> seen = image_estimates(result.film);
  const double values[] = {expected.x, expected.y, expected.z};
  EXPECT_EQ(result.stats.non_finite, 0u);
  for (std::size_t i = 0; i < 3; ++i) {
    // Single precision and tabulated spectra: a small error of the expectation itself.
    const double z = z_score(seen[i], {values[i], tolerance * values[i]});
    EXPECT_LT(std::abs(z), normal_threshold(sidak_significance(0.01, 3 * tests)))
        << what << " channel " << i << ": " << seen[i].mean << " ± " << seen[i].error << ", expected "
        << values[i];
    EXPECT_LT(seen[i].error, 0.03 * values[i]) << what << " channel " << i;
  }
}

Xyz xyz_of(const Spectrum& lamp, double luminance, const Spectrum& factor = ConstantSpectrum{1.0}) {
  const TabulatedSpectrum table = tabulate_emission(lamp);
  const double unit = emission_xyz(table, Observer::cie1931()).y;
  return emission_xyz(tabulate_product(table, factor), Observer::cie1931()) * (luminance / unit);
}

/// The form factor of a parallel rectangle of half sides a, b at distance h, centred above a small patch
/// (Siegel & Howell, configuration factor B-3, four times).
double form_factor(double a, double b, double h) {
  const double x = a / h, y = b / h, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return 4.0 / (2.0 * kPiD) * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
}

/// Whatever the lamp and the sampler, a lamp of luminance L reads Y = L, and X and Z as its spectrum has
/// them.
TEST(ClosedForm, VisibleEmitter) {
  const Spectrum amber = tabulate_product(upsample_reflectance({0.9, 0.4, 0.1}), d65());
  const std::vector<std::pair<std::string, Spectrum>> lamps{{"FL11", fl11()},
                                                            {"D65", d65()},
                                                            {"2700 K", BlackbodySpectrum{2700}},
                                                            {"RGB", amber},
                                                            {"line", LineSpectrum{560, 1}}};
  for (const auto& [name, lamp] : lamps) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 1, 1, b.lamp(lamp, 7.0));
    b.camera({0, 0, 1}, {0, 0, 0}, 30, 8, 8);
    const PreparedScene scene(b.build());
    for (const WavelengthSampler& s : all_samplers(scene_emission(scene))) {
      const bool blind = name == "line" && (s.index() < 2);  // a line of 1 nm is beyond uniform's error bars
      expect_xyz(render(scene, s, options(blind ? 20000 : 1000, 1)), xyz_of(lamp, 7.0), 20,
                 name + std::string(" ") + std::string(sampler_name(s)));
    }
  }
}

TEST(ClosedForm, FloorUnderRectangleLamp) {
  const Spectrum paint = upsample_reflectance({0.5, 0.3, 0.2});
  SceneBuilder b;
  b.floor({0, 0, 0}, 2, 2, b.material(diffuse(paint)));
  b.ceiling({0, 0, 1}, 0.8, 0.5, b.lamp(fl11(), 5.0));
  b.camera({1.2, 0, 0.5}, {0, 0, 0}, 0.05, 8, 8);
  const PreparedScene scene(b.build());
  const Xyz expected = xyz_of(fl11(), 5.0, paint) * form_factor(0.8, 0.5, 1.0);
  for (const WavelengthSampler& s : all_samplers(scene_emission(scene))) {
    expect_xyz(render(scene, s, options(8000, 2)), expected, 8, std::string(sampler_name(s)), 3e-4);
    expect_xyz(render_naive(scene, s, options(8000, 2)), expected, 8, std::string(sampler_name(s)), 3e-4);
  }
}

/// A lamp of 1 cm at 5 m, off the axis: inverse square, both cosines.
TEST(ClosedForm, FloorUnderSmallDistantLamp) {
  SceneBuilder b;
  b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{0.4})));
  b.ceiling({3, 0, 4}, 0.005, 0.005, b.lamp(d65(), 1e6));
  b.camera({-1, 0, 1}, {0, 0, 0}, 0.05, 8, 8);
  const PreparedScene scene(b.build());
  const double irradiance = 1e6 * 1e-4 * 0.8 * 0.8 / 25.0;
  const Xyz expected = xyz_of(d65(), irradiance * 0.4 / kPiD);
  for (const WavelengthSampler& s : all_samplers(scene_emission(scene)))
    expect_xyz(render(scene, s, options(1000, 2)), expected, 4, std::string(sampler_name(s)), 2e-4);
}

/// A double-sided lamp lights what stands behind it too, a single-sided one does not.
TEST(ClosedForm, SidesOfALamp) {
  for (bool both : {false, true}) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{0.5})));
    b.floor({0, 0, 1}, 0.5, 0.5, b.lamp(d65(), 4.0, both));  // its front looks up
    b.camera({1.2, 0, 0.5}, {0, 0, 0}, 0.05, 8, 8);
    const PreparedScene scene(b.build());
    const RenderResult r = render(scene, UniformWavelengths{4}, options(1000, 2));
    if (both)
      expect_xyz(r, xyz_of(d65(), 2.0) * form_factor(0.5, 0.5, 1.0), 1, "both sides", 3e-4);
    else
      EXPECT_EQ(r.film.image_mean().y, 0.0);
  }
}

/// A mirror of metal shows the lamp behind the camera, times its colour.
TEST(ClosedForm, LampInAMirror) {
  const Spectrum gold = upsample_reflectance({0.9, 0.6, 0.2});
  SceneBuilder b;
  b.floor({0, 0, 0}, 1, 1, b.material(metal(gold, 0.0f)));
  b.ceiling({0, 0, 3}, 2, 2, b.lamp(d65(), 3.0));
  b.camera({0, 0, 1}, {0, 0, 0}, 0.05, 8, 8);
  const PreparedScene scene(b.build());
  for (const WavelengthSampler& s : all_samplers(scene_emission(scene)))
    expect_xyz(render(scene, s, options(1000, 2)), xyz_of(d65(), 3.0, gold), 4, std::string(sampler_name(s)),
               2e-4);
}

/// A specular colour above 1 on the reflection of a black, smooth floor.
TEST(ClosedForm, LampInBrightBlackPlastic) {
  const Spectrum tint = upsample_reflectance({0.9, 0.6, 0.2});
  Material black = plastic(ConstantSpectrum{0.0}, 0.0f);
  black.specular_color = tint, black.specular_scale = 2.0f;
  SceneBuilder b;
  b.floor({0, 0, 0}, 1, 1, b.material(black));
  b.ceiling({0, 0, 3}, 2, 2, b.lamp(d65(), 3.0));
  b.camera({0, 0, 1}, {0, 0, 0}, 0.05, 8, 8);
  const PreparedScene scene(b.build());
  const Xyz expected = xyz_of(d65(), 2 * 0.04 * 3.0, tint);
  expect_xyz(render(scene, UniformWavelengths{4}, options(1000, 2)), expected, 2, "render", 2e-4);
  expect_xyz(render_naive(scene, UniformWavelengths{4}, options(1000, 2)), expected, 2, "oracle", 2e-4);
}

/// What a slab of glass lets through: Airy's sum without interference, T = (1 − F)²τ / (1 − F²τ²).
TabulatedSpectrum slab_transmittance(const Spectrum& colour, double fresnel, double distance) {
  std::vector<double> lambda, value;
  for (int nm = 360; nm <= 830; ++nm) {
    const double tau = std::pow(evaluate(colour, nm), distance);
    lambda.push_back(nm);
    value.push_back((1 - fresnel) * (1 - fresnel) * tau / (1 - fresnel * fresnel * tau * tau));
  }
  return {lambda, value, Beyond::end_value};
}

TEST(ClosedForm, AbsorbingSlabOfGlass) {
  const Spectrum colour = upsample_reflectance({0.2, 0.6, 0.4});
  constexpr double kIor = 2.0, kThickness = 0.3, kAttenuationDistance = 0.25;
  Material glass = solid_glass(kIor, 0.0f);
  glass.attenuation_color = colour;
  glass.attenuation_distance = kAttenuationDistance;
  for (double cos_i : {1.0, 0.6}) {
    SceneBuilder b;
    b.floor({0, 0, -2}, 50, 50, b.lamp(fl11(), 5.0));
    b.box({-20, -20, -kThickness}, {20, 20, 0}, b.material(glass));
    const double sin_i = std::sqrt(1 - cos_i * cos_i);
    b.camera({sin_i, 0, cos_i}, {0, 0, 0}, 0.02, 8, 8);
    const PreparedScene scene(b.build());
    const double cos_t = std::sqrt(1 - sin_i * sin_i / (kIor * kIor));
    const double fresnel = fresnel_dielectric(static_cast<float>(cos_i), static_cast<float>(kIor));
    const Spectrum seen = slab_transmittance(colour, fresnel, kThickness / cos_t / kAttenuationDistance);
    for (const WavelengthSampler& s : all_samplers(scene_emission(scene)))
      expect_xyz(render(scene, s, options(1000, 50)), xyz_of(fl11(), 5.0, seen), 8,
                 std::string(sampler_name(s)) + " cos " + std::to_string(cos_i), 5e-4);
  }
}

/// Thin-walled glass: 1 − 2F/(1 + F) of its tint passes, straight on.
TEST(ClosedForm, ThinPane) {
  Material pane = thin_glass(1.5f, 0.0f);
  const Spectrum tint = upsample_reflectance({0.8, 0.5, 0.3});
  pane.base_color = tint;
  SceneBuilder b;
  b.floor({0, 0, -1}, 1, 1, b.lamp(d65(), 5.0));
  b.floor({0, 0, 0}, 1, 1, b.material(pane));
  b.camera({0, 0, 1}, {0, 0, 0}, 0.05, 8, 8);
  const PreparedScene scene(b.build());
  expect_xyz(render(scene, UniformWavelengths{4}, options(1000, 4)),
             xyz_of(d65(), 5.0, tint) * (1 - 0.08 / 1.04), 1, "pane", 2e-4);
}

}  // namespace
}  // namespace photopic
