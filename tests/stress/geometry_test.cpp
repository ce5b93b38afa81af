#include <gtest/gtest.h>

#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;

/// Triangles without area, as exporters write them: they are not there.
TEST(Geometry, DegenerateTrianglesChangeNothing) {
  SceneBuilder plain = diffuse_room(12), odd = diffuse_room(12);
  const auto grey = odd.material(diffuse(ConstantSpectrum{0.5}));
  const auto lamp = odd.lamp(fl11(), 10.0);
  for (const auto m : {grey, lamp}) {
    odd.triangle({0, 0, 1}, {0, 0, 1}, {0, 0, 1}, m);
    odd.triangle({0, 0, 1}, {0.5, 0, 1}, {0.5, 0, 1}, m);
    odd.triangle({-0.5, 0, 1}, {0, 0, 1}, {0.5, 0, 1}, m);
  }
  expect_same_image(render_finite(plain, 200, 8, 5), render_finite(odd, 200, 8, 6), 1, "degenerate");
}

/// A floor of slivers, 4 m long and down to a micron wide, is lit like a floor.
TEST(Geometry, Slivers) {
  for (double width : {1e-2, 1e-4, 1e-6}) {
    SceneBuilder b;
    const auto paint = b.material(diffuse(ConstantSpectrum{0.5}));
    for (int i = -20; i < 20; ++i) {
      const double y0 = i * width, y1 = (i + 1) * width;
      b.quad({-2, y0, 0}, {2, y0, 0}, {2, y1, 0}, {-2, y1, 0}, paint);
    }
    b.quad({-2, 20 * width, 0}, {2, 20 * width, 0}, {2, 2, 0}, {-2, 2, 0}, paint);
    b.quad({-2, -2, 0}, {2, -2, 0}, {2, -20 * width, 0}, {-2, -20 * width, 0}, paint);
    b.ceiling({0, 0, 100}, 0.5, 0.5, b.lamp(d65(), 1e6));
    b.camera({0.3, 0, 1}, {0, 0, 0}, 2000 * width < 20 ? 2000 * width : 20, 8, 8);
    expect_luminance(render_finite(b, 300, 2), 0.5 * 100 / 3.14159265358979, std::to_string(width), 2e-3);
  }
}

TEST(Geometry, SliversAsLamps) {
  SceneBuilder b = diffuse_room(8);
  const auto lamp = b.lamp(fl11(), 1e4);
  for (double width : {1e-3, 1e-6, 1e-9, 1e-20})
    b.triangle({-0.9, 0, 1.5}, {0.9, 0, 1.5}, {0.9, width, 1.5}, lamp);
  render_finite(b, 100, 8);
}

/// A camera in a closed box that stands in, or beside, a bright room sees nothing: not a sample leaks through
/// edges, corners or smooth normals.
TEST(Geometry, NoLightLeaksIntoAClosedBox) {
  const auto expect_dark = [](SceneBuilder& b, const std::string& what) {
    for (const auto& [scale, offset] :
         {std::pair{1.0, Vec3d{}}, {1e-3, Vec3d{}}, {1e4, Vec3d{}}, {1.0, Vec3d{1000, 1000, -1000}}}) {
      SceneBuilder placed = b;
      if (scale != 1.0) placed.turn({1, 2, 3}, 0.6);
      const Film film = render_finite(placed.place(scale, offset), 60, 20);
      EXPECT_EQ(film.image_mean().y, 0.0) << what << " scale " << scale << " offset " << offset.x;
    }
  };
  for (const Material& m : {diffuse(ConstantSpectrum{0.9}), metal(ConstantSpectrum{0.95}, 0.4f),
                            metal(ConstantSpectrum{0.95}, 0.0f), plastic(ConstantSpectrum{0.9}, 0.2f)}) {
    for (int kind = 0; kind < 3; ++kind) {
      SceneBuilder b;
      b.box({-3, -3, -3}, {3, 3, 3}, b.lamp(d65(), 1e6), true);
      if (kind == 0)
        b.box({-1, -0.7, -0.6}, {1.1, 0.9, 0.8}, b.material(m));
      else
        b.sphere({0.1, 0.05, 0}, 1.0, 2, b.material(m), kind == 2);
      b.camera({0.1, -0.3, 0.2}, {1, 1, 1}, 100, 8, 8);
      expect_dark(b, "kind " + std::to_string(kind));
    }
    SceneBuilder beside;  // a dark room and a bright one share a wall
    beside.box({-1, -1, -1}, {1, 1, 1}, beside.material(m), true);
    beside.box({1, -1, -1}, {3, 1, 1}, beside.lamp(d65(), 1e6), true);
    beside.camera({-0.5, 0, 0}, {1, 0.2, 0.1}, 100, 8, 8);
    expect_dark(beside, "beside");
  }
}

/// Smooth normals on few facets: the darkest corners of interpolation, no NaN.
TEST(Geometry, CoarseSmoothSpheres) {
  SceneBuilder b = lamp_room(d65(), 16);
  b.sphere({-0.4, 0, 0.5}, 0.4, 0, b.material(metal(ConstantSpectrum{0.9}, 0.05f)));
  b.sphere({0.4, 0, 0.5}, 0.4, 0, b.material(solid_glass(1.5f, 0.3f)));
  b.sphere({0, 0.5, 1.3}, 0.3, 1, b.material(plastic(ConstantSpectrum{0.9}, 0.0f)));
  render_finite(b, 200, 20);
}

/// Rays that run in a surface's own plane, along edges and through vertices.
TEST(Geometry, RaysAlongEdges) {
  SceneBuilder b = lamp_room(d65(), 16);
  b.box({-0.5, -0.5, 0.5}, {0.5, 0.5, 1.0}, b.material(diffuse(ConstantSpectrum{0.5})));
  for (const Vec3d& eye :
       {Vec3d{-0.5, -0.9, 1.0}, Vec3d{0.5, -0.9, 0.5}, Vec3d{0, -0.9, 1.0}, Vec3d{0.9, 0.9, 1.0}}) {
    b.camera(eye, {eye.x, 1, eye.z}, 0.001, 5, 5);
    render_finite(b, 50, 5);
  }
}

}  // namespace
}  // namespace photopic
