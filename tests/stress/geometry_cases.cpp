#include <cmath>
#include <numbers>

#include "stress_case.h"

namespace photopic::test {
namespace {

/// A floor of slivers, 4 m long, lit by 100 lx.
SceneBuilder sliver_floor(double width, double turn) {
  SceneBuilder b;
  const auto paint = b.material(diffuse(ConstantSpectrum{0.5}));
  for (int i = -20; i < 20; ++i) {
    const double y0 = i * width, y1 = (i + 1) * width;
    b.quad({-2, y0, 0}, {2, y0, 0}, {2, y1, 0}, {-2, y1, 0}, paint);
  }
  b.quad({-2, 20 * width, 0}, {2, 20 * width, 0}, {2, 2, 0}, {-2, 2, 0}, paint);
  b.quad({-2, -2, 0}, {2, -2, 0}, {2, -20 * width, 0}, {-2, -20 * width, 0}, paint);
  b.ceiling({0, 0, 100}, 0.5, 0.5, b.lamp(d65(), 1e6));
  b.camera({0.3, 0, 1}, {0, 0, 0}, std::min(2000 * width, 20.0), 8, 8);
  return b.turn({1, 2, 3}, turn);
}

void add_slivers(StressList& list) {
  for (const double width : list.steps({1e-2, 1e-4, 1e-6}, {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}))
    for (const double turn : {0.0, 0.7}) {
      if (turn > 0 && width < 1e-5) continue;  // rounded corners tilt the slivers themselves
      list.add({"slivers", with_number("floor of slivers, width", width) + (turn > 0 ? ", turned" : ""),
                built(sliver_floor(width, turn)), Luminance{50 / std::numbers::pi, 1e-3}, 300, 2});
    }

  const bool full = list.form() == Form::full;
  const auto room = std::make_shared<Reference>(
      "as without", [full] { return render_reference(diffuse_room(12).build(), full ? 3000 : 400, 8); });
  // Triangles without area, as exporters write them: they are not there.
  SceneBuilder odd = diffuse_room(12);
  for (const auto m : {odd.material(diffuse(ConstantSpectrum{0.5})), odd.lamp(fl11(), 10.0)}) {
    odd.triangle({0, 0, 1}, {0, 0, 1}, {0, 0, 1}, m);
    odd.triangle({0, 0, 1}, {0.5, 0, 1}, {0.5, 0, 1}, m);
    odd.triangle({-0.5, 0, 1}, {0, 0, 1}, {0.5, 0, 1}, m);
  }
  list.add({"slivers", "triangles without area", built(odd), room, 200, 8});
  // Lamps without any area to speak of, of a luminance that is a lamp's: they add nothing either.
  SceneBuilder lamps = diffuse_room(12);
  const auto lamp = lamps.lamp(fl11(), 1e4);
  for (const double width : {1e-9, 1e-12, 1e-20})
    lamps.triangle({-0.9, 0, 1.5}, {0.9, 0, 1.5}, {0.9, width, 1.5}, lamp);
  list.add({"slivers", "lamps of slivers", built(lamps), room, 200, 8});

  // A sliver that shines: its irradiance is that of its area.
  for (const double width : list.steps({1e-4, 1e-6}, {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8})) {
    SceneBuilder b;
    b.floor({0, 0, 0}, 2, 2, b.material(diffuse(ConstantSpectrum{0.5})));
    b.triangle({-0.05, 0, 10}, {-0.05, width, 10}, {0.05, 0, 10}, b.lamp(d65(), 1e5 / width));
    b.camera({-1, 0, 1}, {0, 0, 0}, 0.02, 8, 8);
    list.add({"slivers", with_number("lamp of 0.1 m by", width), built(b),
              Luminance{0.5 * 1e5 * 0.05 / 100 / std::numbers::pi, 3e-4}, 300, 2});
  }
}

/// Rays in a surface's own plane, along edges and through vertices: as just beside them.
void add_edges(StressList& list) {
  const auto room = [](Vec3d eye) {
    SceneBuilder b;
    b.box({-2, -2, -2}, {2, 2, 3}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
    b.box({-0.5, -0.5, 0.5}, {0.5, 0.5, 1.0}, b.material(diffuse(ConstantSpectrum{1.0})));
    b.camera(eye, {eye.x, 1, eye.z}, 0.001, 5, 5);
    return b;
  };
  int i = 0;
  for (const Vec3d& eye :
       {Vec3d{-0.5, -0.9, 1.0}, Vec3d{0.5, -0.9, 0.5}, Vec3d{0, -0.9, 1.0}, Vec3d{0.9, 0.9, 1.0}})
    list.add(
        {"edges", with_number("white box seen along an edge,", ++i), built(room(eye)), Luminance{3.0}, 100});
}

}  // namespace

void add_geometry_cases(StressList& list) {
  add_slivers(list);
  add_edges(list);
}

}  // namespace photopic::test
