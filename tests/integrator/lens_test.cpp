#include <gtest/gtest.h>

#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

/// The edge of a half-plane lamp out of focus: a pixel whose sharp point lies s blur radii inside sees the
/// part of a disk on one side of a chord, 1/2 + (asin s + s·√(1 − s²))/π.
TEST(Lens, EdgeOutOfFocus) {
  constexpr int kWidth = 21;
  constexpr double kDepth = 5.0, kFocus = 2.0, kAperture = 0.1,
                   kBlur = kAperture * (kDepth - kFocus) / kFocus;
  for (const bool orthographic : {false, true}) {
    SceneBuilder b;
    b.quad({-50, -50, -kDepth}, {0, -50, -kDepth}, {0, 50, -kDepth}, {-50, 50, -kDepth},
           b.lamp(ConstantSpectrum{1.0}, 1.0, true));
    b.camera({0, 0, 0}, {0, 0, -1}, 1, kWidth, kWidth);
    Scene scene = b.build();
    const double half = 1.2 * kBlur;  // of the view at the lamp's depth
    scene.camera.right = {1, 0, 0}, scene.camera.up = {0, 1, 0}, scene.camera.back = {0, 0, 1};
    if (orthographic)
      scene.camera.half_height = static_cast<float>(half);
    else
      scene.camera.tan_half_yfov = static_cast<float>(half / kDepth);
    scene.camera.aperture_radius = kAperture, scene.camera.focus_distance = kFocus;
    const Film film = render_finite(PreparedScene(std::move(scene)), 300, 2);
    for (int x = 0; x < kWidth; ++x) {
      const double pixel = 2 * half / kWidth;
      double expected = 0.0;  // the mean over the pixel's width
      constexpr int kSteps = 64;
      for (int i = 0; i < kSteps; ++i) {
        const double s = std::clamp((half - (x + (i + 0.5) / kSteps) * pixel) / kBlur, -1.0, 1.0);
        expected += (0.5 + (std::asin(s) + s * std::sqrt(1 - s * s)) / 3.14159265358979) / kSteps;
      }
      const Estimate seen = block_estimates(film, x, 0, x + 1, kWidth)[1];
      EXPECT_NEAR(seen.mean, expected, 4.5 * seen.error + 2e-3) << x;
    }
  }
}

}  // namespace
}  // namespace photopic
