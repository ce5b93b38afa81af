#include "stress_case.h"
#include "support/instances.h"

namespace photopic::test {
namespace {

/// Places as scenes have them, and worse: turned, stretched, mirrored, small, sheared.
std::vector<Affine> odd_places(double scale) {
  Affine sheared = placement({0.1, 0.1, 0.1}, {1, 0, 2}, 0.4, {0.6, -0.5, 0.3});
  sheared.y = sheared.y + sheared.x * 0.8;
  std::vector<Affine> places{placement({0.3, 0.3, 0.3}, {0, 0, 1}, 0.0, {0.4, 0, 0.3}),
                             placement({0.1, 0.4, 0.2}, {1, 2, 3}, 1.0, {-0.4, 0.3, 0.5}),
                             placement({-0.2, 0.2, 0.2}, {3, -1, 1}, 2.0, {0.5, 0.5, 1.4}),
                             placement({-0.2, -0.1, -0.3}, {0, 1, 0}, 0.7, {-0.5, 0.3, 1.4}),
                             placement({0.01, 0.01, 0.01}, {0, 1, 1}, 3.0, {0, -0.7, 1.0}),
                             sheared};
  for (Affine& place : places) place.t = place.t * scale;
  return places;
}

Scene room_of_instances(const Material& material, double scale) {
  SceneBuilder b = lamp_room(d65(), 12);
  b.sphere({}, 1.0, 3, b.material(material));
  b.place(scale);
  return with_instances(b.build(), odd_places(scale));
}

/// As the same triangles in the world, baked in double precision.
void add_baked(StressList& list, const std::string& name, const Material& material) {
  const bool full = list.form() == Form::full;
  for (const double scale : list.steps({1e-3, 1e4}, {1e-4, 1e-3, 1, 1e2, 1e4, 1e6})) {
    const auto reference = std::make_shared<Reference>("as baked", [=] {
      return render_reference(baked(room_of_instances(material, scale)), full ? 1500 : 200, 10);
    });
    list.add({"instances", with_number(name + ", times", scale),
              [=] { return room_of_instances(material, scale); }, reference, 150, 10});
  }
}

Scene white_instance(double size, Vec3d at, Vec3d stretch) {
  SceneBuilder b;
  const double far = std::max(10.0, 4 * max_abs(at));
  b.box({-far, -far, -far}, {far, far, far}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.sphere({}, size, 3, b.material(diffuse(ConstantSpectrum{1.0})), false);
  b.camera(at + Vec3d{2.5, 0.3, 0.5}, at, 22, 8, 8);
  return with_instances(b.build(), {placement(stretch * (1 / size), {1, -2, 0.5}, 1.1, at)});
}

Scene dark_instance(Vec3d at, Vec3d stretch) {
  SceneBuilder b;
  b.box({-3000, -3000, -3000}, {3000, 3000, 3000}, b.lamp(d65(), 1e6), true);
  b.sphere({}, 1.0, 2, b.material(metal(ConstantSpectrum{0.95}, 0.4f)));
  b.camera(at + Vec3d{0.1, -0.3, 0.2}, at + Vec3d{1, 1, 1}, 100, 8, 8);
  return with_instances(b.build(), {placement(stretch, {2, 1, 1}, 0.8, at)});
}

}  // namespace

void add_instance_cases(StressList& list) {
  add_baked(list, "paint", diffuse(ConstantSpectrum{0.6}));
  add_baked(list, "metal", metal(ConstantSpectrum{0.9}, 0.3f));
  add_baked(list, "glass", solid_glass(1.5f, 0.0f));

  // No shadow on itself, whatever the prototype's size.
  for (const double size : list.steps({1e-4, 1e4}, {1e-6, 1e-4, 1e-2, 1, 1e2, 1e4, 1e6}))
    for (const Vec3d& at : {Vec3d{}, Vec3d{1000, -1000, 1000}, Vec3d{300, 2, -10}})
      for (const Vec3d& stretch : {Vec3d{1, 1, 1}, Vec3d{-1, 0.6, 1.2}})
        list.add({"instances",
                  with_number(with_number(with_number("white ball, prototype of", size) + " m at x", at.x) +
                                  ", y stretched",
                              stretch.y),
                  [=] { return white_instance(size, at, stretch); }, Luminance{3.0, 2e-6}, 100, 3});

  for (const Vec3d& at : {Vec3d{}, Vec3d{500, -700, 200}})
    for (const Vec3d& stretch : {Vec3d{1, 1, 1}, Vec3d{-2, 0.7, 1.5}})
      list.add({"instances",
                with_number(with_number("inside a closed ball at x", at.x) + ", y stretched", stretch.y),
                [=] { return dark_instance(at, stretch); }, Dark{}, 60, 20});
}

}  // namespace photopic::test
