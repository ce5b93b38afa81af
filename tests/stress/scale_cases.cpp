#include "stress_case.h"

namespace photopic::test {
namespace {

/// Something of everything that does not know lengths.
SceneBuilder mixed_room() {
  SceneBuilder b = lamp_room(d65(), 12);
  b.box({-0.7, 0.1, 0}, {-0.2, 0.5, 1.1}, b.material(plastic(ConstantSpectrum{0.5}, 0.3f)));
  b.sphere({0.45, 0, 0.4}, 0.4, 3, b.material(solid_glass(1.5f, 0.0f)));
  b.sphere({0.1, 0.6, 1.2}, 0.25, 3, b.material(metal(ConstantSpectrum{0.9}, 0.1f)));
  b.sphere({-0.3, -0.4, 0.25}, 0.2, 2, b.material(diffuse(ConstantSpectrum{0.8})));
  return b;
}

}  // namespace

/// Radiance has no length in it: a room of 0.2 mm and one of 2000 km look alike, wherever they stand.
void add_scale_cases(StressList& list) {
  const bool full = list.form() == Form::full;
  const auto reference = std::make_shared<Reference>(
      "as at 1 m", [full] { return render_reference(mixed_room().build(), full ? 3000 : 500, 12); });
  const auto add = [&](const std::string& name, std::function<Scene()> scene) {
    list.add({"scale", name, std::move(scene), reference, 120, 12});
  };

  const auto oracle = std::make_shared<Reference>(
      "as the oracle sees it", [full] { return render_oracle(mixed_room().build(), full ? 3000 : 500, 12); });
  list.add({"scale", "room of 2 m", built(mixed_room()), oracle, 200, 12});

  for (const double scale :
       list.steps({1e-4, 1e2, 1e6}, {1e-4, 1e-3, 1e-2, 1e-1, 10, 1e2, 1e3, 1e4, 1e5, 1e6}))
    add(with_number("times", scale), built(mixed_room().place(scale)));

  // As the loader keeps it: coordinates relative to the scene's middle.
  for (const Vec3d& far : {Vec3d{1e5, -1e5, 1e5}, Vec3d{1e5, 0, 0}, Vec3d{-7e4, 3e4, 6.5e4}})
    for (const double scale : list.steps({1}, {1e-4, 1e-2, 1, 1e2, 1e4}))
      add(with_number(with_number("1e5 m away at x", far.x) + ", times", scale),
          [=] { return mixed_room().place(scale, far).build(far); });

  // Without that single precision has to do: a kilometre away a unit in the last place is 0.06 mm.
  for (const Vec3d& offset : {Vec3d{1e3, 0, 0}, Vec3d{0, -1e3, 1e3}, Vec3d{1e2, 1e2, 1e2}})
    add(with_number(with_number("raw offset x", offset.x) + ", z", offset.z),
        built(mixed_room().place(1.0, offset)));
}

}  // namespace photopic::test
