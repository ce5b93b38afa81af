#include <cmath>

#include "furnace.h"
#include "stress_case.h"
#include "support/layered_materials.h"

namespace photopic::test {
namespace {

/// A closed box whose walls all shine with 1 cd/m² and reflect a share ρ: a path of n surfaces sees
/// 1 + ρ + … + ρⁿ⁻¹.
StressCase glowing_box(Material m, double albedo, int max_depth, const std::string& name) {
  SceneBuilder b;
  m.emission_spectrum = b.emission(d65());
  m.emission_luminance = 1.0f;
  b.box({-1, -1, -1}, {1, 1, 1}, b.material(m), true);
  // A mirror reflects so much head-on alone: to and fro between two walls, that is.
  const bool mirror = m.metallic == 1.0f;
  b.camera({0, 0, 0}, mirror ? Vec3d{1, 0, 0} : Vec3d{1, 0.2, 0.1}, mirror ? 0.01 : 70, 6, 6);
  const double sum = albedo == 1 ? max_depth : (1 - std::pow(albedo, max_depth)) / (1 - albedo);
  StressCase c{"albedo", with_number(with_number(name + " of albedo", albedo) + ", bounces", max_depth),
               built(b), Luminance{sum, 1e-3},
               200,      max_depth};
  if (max_depth >= 1000) c.spp = albedo == 1 ? 16 : 60;
  c.largest_error = 0.03;
  return c;
}

/// Gold and glass, smooth and rough, piled up in a furnace: light is focused everywhere, and nothing can be
/// brighter than the furnace.
SceneBuilder pile(float roughness) {
  SceneBuilder b;
  b.box({-3, -3, 0}, {3, 3, 4}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.floor({0, 0, 0.01}, 2, 2, b.material(diffuse(ConstantSpectrum{1.0})));
  const auto gold = b.material(metal(ConstantSpectrum{1.0}, roughness));
  const auto glass = b.material(solid_glass(1.5f, roughness));
  const auto plastic_white = b.material(plastic(ConstantSpectrum{1.0}, roughness));
  b.sphere({-0.8, 0, 0.52}, 0.5, 3, glass, false);
  b.sphere({0.3, 0.3, 0.52}, 0.5, 3, gold, false);
  b.sphere({0.1, -0.7, 0.42}, 0.4, 2, plastic_white, false);
  b.box({-0.4, -0.3, 1.05}, {0.5, 0.5, 1.4}, glass);
  b.camera({0.5, -2.6, 1.9}, {0, 0, 0.6}, 45, 24, 24);
  return b;
}

/// So dark that no wavelength is left where a path meets the far side.
Material ink(float roughness) {
  Material m = solid_glass(1.5f, roughness);
  m.attenuation_color = ConstantSpectrum{0.0};
  m.attenuation_distance = 1e-6f;
  return m;
}

/// Extremes of what a file may say. None is brighter than the furnace; the oracle says how bright.
std::vector<std::pair<const char*, Material>> odd_materials() {
  std::vector<std::pair<const char*, Material>> odd{
      {"black mirror", metal(ConstantSpectrum{0.0}, 0.0f)},
      {"black plastic", plastic(ConstantSpectrum{0.0}, 1.0f)},
      {"plastic of index 0", plastic(ConstantSpectrum{1.0}, 0.3f, 0.0f)},
      {"glass of index 0", solid_glass(0.0f, 0.0f)},
      {"rough glass of index 0", solid_glass(0.0f, 0.5f)}};
  odd.push_back({"ink of 1 micron", ink(0.2f)});
  odd.push_back({"dispersive ink", dispersive(ink(0.0f), "SF11")});
  odd.push_back({"rough dispersive ink", dispersive(ink(0.2f), "SF11")});
  odd.push_back({"ink under a film", iridescent(ink(0.0f), 400.0f)});
  odd.push_back({"rough ink under a film", iridescent(ink(0.2f), 400.0f)});
  Material thin_ink = ink(0.2f);
  thin_ink.attenuation_color = ConstantSpectrum{1e-30};
  thin_ink.attenuation_distance = 1e6f;
  odd.push_back({"ink of 1000 km", thin_ink});
  Material mix = solid_glass(1.5f, 0.3f);
  mix.metallic = 0.5f, mix.transmission = 0.5f, mix.specular = 0.0f;
  odd.push_back({"glass and metal without specular", mix});
  mix.specular_color = ConstantSpectrum{100.0};
  mix.specular = 1.0f;
  odd.push_back({"glass and metal of specular colour 100", mix});
  return odd;
}

}  // namespace

void add_material_cases(StressList& list) {
  for (const double albedo :
       list.steps({0, 0.5, 0.9}, {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}))
    list.add(glowing_box(diffuse(ConstantSpectrum{albedo}), albedo, 64, "paint"));
  for (const double albedo : list.steps({0.999, 1}, {0.99, 0.999, 0.9999, 1})) {
    list.add(glowing_box(diffuse(ConstantSpectrum{albedo}), albedo, 1000, "paint"));
    list.add(glowing_box(metal(ConstantSpectrum{albedo}, 0.0f), albedo, 1000, "mirror"));
  }

  for (const double roughness : list.steps({0, 0.3}, {0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1})) {
    StressCase c{"fireflies",
                 with_number("gold, glass and plastic in a furnace, roughness", roughness),
                 built(pile(static_cast<float>(roughness))),
                 Luminance{3.0, 2e-3},
                 32,
                 1000};
    c.brightest_pixel = 6.0;
    list.add(c);
  }

  const bool full = list.form() == Form::full;
  for (const auto& [name, material] : odd_materials()) {
    const Scene scene = furnace(material).build();
    const auto oracle = std::make_shared<Reference>(
        "as the oracle sees it", [=] { return render_oracle(scene, full ? 600 : 60, 40); });
    list.add({"odd materials", name, [=] { return scene; }, oracle, 60, 40});
  }
}

}  // namespace photopic::test
