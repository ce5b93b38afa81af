#include "stress_case.h"

namespace photopic::test {
namespace {

struct Named {
  const char* name;
  Material material;
};

std::vector<Named> wall_materials() {
  return {{"paint", diffuse(ConstantSpectrum{0.9})},
          {"rough metal", metal(ConstantSpectrum{0.95}, 0.4f)},
          {"mirror", metal(ConstantSpectrum{0.95}, 0.0f)},
          {"plastic", plastic(ConstantSpectrum{0.9}, 0.2f)}};
}

enum class Shell { box, facets, smooth, beside };
constexpr const char* kShellNames[] = {"box", "facets", "smooth ball", "room beside"};

/// A camera in a closed shell that stands in, or beside, a bright room.
SceneBuilder dark_room(const Material& m, Shell shell) {
  SceneBuilder b;
  if (shell == Shell::beside) {
    b.box({-1, -1, -1}, {1, 1, 1}, b.material(m), true);
    b.box({1.01, -1, -1}, {3, 1, 1}, b.lamp(d65(), 1e6), true);
    b.camera({-0.5, 0, 0}, {1, 0.2, 0.1}, 100, 8, 8);
    return b;
  }
  b.box({-3, -3, -3}, {3, 3, 3}, b.lamp(d65(), 1e6), true);
  if (shell == Shell::box)
    b.box({-1, -0.7, -0.6}, {1.1, 0.9, 0.8}, b.material(m));
  else
    b.sphere({0.1, 0.05, 0}, 1.0, 2, b.material(m), shell == Shell::smooth);
  b.camera({0.1, -0.3, 0.2}, {1, 1, 1}, 100, 8, 8);
  return b;
}

struct Place {
  double scale, turn;
  Vec3d offset;
};

}  // namespace

/// Not a sample leaks through edges, corners or smooth normals.
void add_leak_cases(StressList& list) {
  std::vector<Place> places{{1, 0, {}}, {1e-3, 0.6, {}}, {1e6, 0.6, {}}, {1, 0.6, {1000, 1000, -1000}}};
  if (list.form() == Form::full)
    for (const Place& p : {Place{1e-4, 1.1, {}},
                           {1e2, 0.3, {}},
                           {1e4, 2.0, {}},
                           {1, 0.2, {100, -300, 20}},
                           {1, 2.2, {-3000, 10, 0.5}},
                           {10, 0.9, {1e4, 1e4, -1e4}}})
      places.push_back(p);
  for (const Named& wall : wall_materials())
    for (const Shell shell : {Shell::box, Shell::facets, Shell::smooth, Shell::beside})
      for (const Place& place : places) {
        SceneBuilder b = dark_room(wall.material, shell);
        b.turn({1, 2, 3}, place.turn).place(place.scale, place.offset);
        std::string name = std::string(kShellNames[static_cast<int>(shell)]) + " of " + wall.name;
        name = with_number(name + ", times", place.scale);
        if (place.offset.x != 0.0) name = with_number(name + " at x", place.offset.x);
        list.add({"leaks", name, built(b), Dark{}, 60, 20});
      }
}

}  // namespace photopic::test
