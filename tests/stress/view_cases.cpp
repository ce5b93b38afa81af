#include <cmath>
#include <numbers>

#include "stress_case.h"

namespace photopic::test {

/// A lamp that covers a known share of the view, from a telescope's to a fisheye's; and a furnace, which
/// looks the same at every angle.
void add_view_cases(StressList& list) {
  constexpr double kShare = 0.437;  // of the view's side: no pixel's edge
  for (const double fov : list.steps(
           {0.01, 1, 120, 179}, {0.01, 0.02, 0.05, 0.1, 0.5, 1, 10, 45, 90, 120, 150, 170, 175, 178, 179})) {
    const double tangent = std::tan(0.5 * fov * std::numbers::pi / 180);
    for (const double distance : {1.0, 1e5}) {
      const double half = kShare * tangent * distance;
      SceneBuilder b;
      b.floor({0, 0, -distance}, half, half, b.lamp(d65(), 3.0));
      b.camera({0, 0, 0}, {0, 0, -1}, fov, 12, 12);
      list.add({"field of view", with_number(with_number("", fov) + "°, lamp at", distance), built(b),
                Luminance{3.0 * kShare * kShare, 3e-4}, 2000, 1});
    }
    SceneBuilder b;
    b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
    b.box({0.5, -0.3, -0.3}, {1.1, 0.3, 0.3}, b.material(diffuse(ConstantSpectrum{1.0})));
    b.camera({0.1, 0.2, 0.3}, {1, 0, 0}, fov, 12, 12);
    list.add({"field of view", with_number("", fov) + "°, furnace", built(b), Luminance{3.0}, 60});
  }
}

}  // namespace photopic::test
