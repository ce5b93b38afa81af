#include <gtest/gtest.h>

#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

/// Something of everything that does not know lengths.
SceneBuilder mixed_room() {
  SceneBuilder b = lamp_room(d65(), 12);
  b.box({-0.7, 0.1, 0}, {-0.2, 0.5, 1.1}, b.material(plastic(ConstantSpectrum{0.5}, 0.3f)));
  b.sphere({0.45, 0, 0.4}, 0.4, 3, b.material(solid_glass(1.5f, 0.0f)));
  b.sphere({0.1, 0.6, 1.2}, 0.25, 3, b.material(metal(ConstantSpectrum{0.9}, 0.1f)));
  b.sphere({-0.3, -0.4, 0.25}, 0.2, 2, b.material(diffuse(ConstantSpectrum{0.8})));
  return b;
}

constexpr int kSpp = 120;

/// Radiance has no length in it: a room of 0.2 mm and one of 2000 km look alike.
TEST(Scale, ImageDoesNotDependOnUnits) {
  const Film reference = render_finite(mixed_room(), 2 * kSpp, 12, 99);
  const double scales[] = {1e-4, 1e-3, 1e-2, 1e2, 1e4, 1e6};
  for (double scale : scales) {
    SceneBuilder b = mixed_room();
    expect_same_image(reference, render_finite(b.place(scale), kSpp), std::size(scales),
                      std::to_string(scale));
  }
}

/// Far from the world's zero the loader keeps coordinates relative to the scene's middle.
TEST(Scale, FarAwayWithOrigin) {
  const Film reference = render_finite(mixed_room(), 2 * kSpp, 12, 99);
  const Vec3d far{1e5, -1e5, 1e5};
  SceneBuilder b = mixed_room();
  const Scene scene = b.place(1.0, far).build(far);
  EXPECT_EQ(scene.origin.x, 1e5);
  expect_same_image(reference, render_finite(PreparedScene(scene), kSpp), 1, "origin");
}

/// Without that, single precision has to do: a kilometre away a unit in the last place is 0.06 mm.
TEST(Scale, RawOffset) {
  const Film reference = render_finite(mixed_room(), 2 * kSpp, 12, 99);
  const Vec3d offsets[] = {{1e3, 0, 0}, {0, -1e3, 1e3}, {1e2, 1e2, 1e2}};
  for (const Vec3d& offset : offsets) {
    SceneBuilder b = mixed_room();
    expect_same_image(reference, render_finite(b.place(1.0, offset), kSpp), std::size(offsets), "offset");
  }
}

TEST(Scale, FieldsOfView) {
  for (double fov : {0.01, 1.0, 120.0, 179.0}) {
    SceneBuilder b;
    b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
    b.camera({0.1, 0.2, 0.3}, {1, 0, 0}, fov, 12, 12);
    expect_luminance(render_finite(b, 30), 3.0, std::to_string(fov));
    SceneBuilder room = mixed_room();
    room.camera({0, -0.98, 1.0}, {0, 1, 0.8}, fov, 12, 12);
    render_finite(room, 10);
  }
}

/// Luminance is a factor, from starlight to lasers: the same samples, scaled.
TEST(Scale, Luminances) {
  const auto lit = [](double luminance) {
    SceneBuilder b = mixed_room();
    Scene scene = b.build();
    for (Material& m : scene.materials)
      if (m.emission_spectrum >= 0) m.emission_luminance = static_cast<float>(luminance);
    return luminance > 0 ? render_finite(PreparedScene(scene), 30) : Film(1, 1);
  };
  const double reference = luminance(lit(1.0)).mean;
  for (double l : {1e-8, 1e-4, 1e4, 1e8, 1e12})
    EXPECT_NEAR(luminance(lit(l)).mean / l, reference, 1e-4 * reference) << l;
}

}  // namespace
}  // namespace photopic
