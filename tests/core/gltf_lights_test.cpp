#include <numbers>

#include "core/gltf_fixture.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

/// The square with lights hanging at further nodes.
SquareFile lit_square(const std::string& lights, const std::string& nodes, const std::string& roots) {
  SquareFile file;
  file.nodes = R"([{"mesh": 0}, )" + nodes + "]";
  file.roots = "[0, " + roots + "]";
  file.more =
      R"(, "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [)" +
      lights + "]}}";
  return file;
}

std::string light_node(int light, const std::string& more = "") {
  return fmt::format(R"({{"extensions": {{"KHR_lights_punctual": {{"light": {}}}}}{}}})", light, more);
}

constexpr const char* kThree =
    R"({"type": "point", "name": "bulb", "intensity": 20},
       {"type": "spot", "name": "lamp", "intensity": 40, "color": [0, 1, 0],
        "spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.6}},
       {"type": "directional", "name": "sun", "color": [0.5, 0.5, 0.5]})";

SquareFile three_lights() {
  return lit_square(kThree,
                    light_node(0, R"(, "translation": [1, 2, 3], "scale": [5, 5, 5])") + "," +
                        light_node(1, R"(, "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476])") +
                        "," + light_node(2, R"(, "scale": [1e-3, 2, 7])"),
                    "1, 2, 3");
}

void expect_close(Vec3f a, Vec3f b) {
  EXPECT_LT(length(a - b), 1e-5f) << a.x << " " << a.y << " " << a.z;
}

TEST_F(GltfTest, PunctualLights) {
  const Scene scene = load(three_lights().str());
  ASSERT_EQ(scene.punctual_lights.size(), 3u);
  const auto& [point, spot, sun] =
      std::tie(scene.punctual_lights[0], scene.punctual_lights[1], scene.punctual_lights[2]);
  EXPECT_EQ(point.kind, PunctualLight::Kind::point);
  expect_close(to_float(to_double(point.position) + scene.origin), {1, 2, 3});
  EXPECT_FLOAT_EQ(point.intensity, 20.0f);  // nodes do not scale it
  EXPECT_EQ(spot.kind, PunctualLight::Kind::spot);
  expect_close(spot.direction, {0, -1, 0});  // −z, turned a quarter about x
  EXPECT_NEAR(spot.intensity, 40 * 0.7152, 1e-2);
  EXPECT_NEAR(spot.cos_inner, std::cos(0.3), 1e-6);
  EXPECT_NEAR(spot.cos_outer, std::cos(0.6), 1e-6);
  EXPECT_EQ(sun.kind, PunctualLight::Kind::directional);
  expect_close(sun.direction, {0, 0, -1});
  EXPECT_NEAR(sun.intensity, 0.5, 1e-6);
  EXPECT_EQ(scene.emission_spectra.size(), 2u);  // white twice, green
  EXPECT_EQ(point.emission_spectrum, sun.emission_spectrum);
  EXPECT_FALSE(scene.environment);
  EXPECT_TRUE(scene.warnings.empty());
}

/// A spot has its intensity along its axis, however narrow; a hard edge is bright to the edge.
TEST(PunctualLights, NarrowAndHardSpots) {
  PunctualLight spot{.kind = PunctualLight::Kind::spot, .intensity = 1.0f};
  for (const double degrees : {0.2, 1.0, 30.0}) {
    const double outer = degrees * std::numbers::pi / 180.0;
    spot.cos_outer = static_cast<float>(std::cos(outer));
    for (const float inner : {1.0f, spot.cos_outer}) {
      spot.cos_inner = inner;
      EXPECT_FLOAT_EQ(spot.attenuation(1.0f), 1.0f) << degrees;
      EXPECT_EQ(spot.attenuation(static_cast<float>(std::cos(1.1 * outer))), 0.0f) << degrees;
    }
    const double cone = 2.0 * std::numbers::pi * (1.0 - std::cos(outer));  // hard
    EXPECT_NEAR(spot.power(1.0), cone, 0.15 * cone) << degrees;
  }
}

TEST_F(GltfTest, SpectraOfPunctualLights) {
  const Scene scene = load(three_lights().str(),
                           {.emitters = {{"bulb", "cie:A"}, {"sun", "cie:FL2"}}, .punctual_scale = 0.5});
  EXPECT_EQ(scene.emission_names.size(), 3u);
  EXPECT_EQ(scene.emission_names.at(scene.punctual_lights.at(0).emission_spectrum), "cie:A");
  EXPECT_EQ(scene.emission_names.at(scene.punctual_lights.at(2).emission_spectrum), "cie:FL2");
  EXPECT_FLOAT_EQ(scene.punctual_lights[0].intensity, 10.0f);
  for (const auto& spectrum : scene.emission_spectra)
    EXPECT_NEAR(emission_xyz(spectrum, Observer::cie1931()).y, 1.0, 1e-9);
  EXPECT_NE(refusal(three_lights().str(), {.emitters = {{"torch", "cie:A"}}}).find("\"bulb\""),
            std::string::npos);

  const std::string own = R"({"type": "point", "extras": {"emission_spectrum": "cie:FL11"}})";
  EXPECT_EQ(load(lit_square(own, light_node(0), "1").str()).emission_names,
            (std::vector<std::string>{"cie:FL11"}));
  const std::string odd = R"({"type": "point", "extras": {"emission_spectrum": "cie:FL99"}})";
  EXPECT_NE(refusal(lit_square(odd, light_node(0), "1").str())
                .find("/extensions/KHR_lights_punctual/lights/0/extras"),
            std::string::npos);
}

/// Cones whose inner angle is not smaller are a hard edge; unknown kinds and ranges are told; dark lights are
/// none.
TEST_F(GltfTest, OddPunctualLights) {
  const std::string hard = R"({"type": "spot", "spot": {"innerConeAngle": 0.4, "outerConeAngle": 0.4}})";
  const Scene spot = load(lit_square(hard, light_node(0), "1").str());
  EXPECT_EQ(spot.punctual_lights.at(0).cos_inner, spot.punctual_lights.at(0).cos_outer);

  const std::string odd = R"({"type": "point", "range": 3}, {"type": "point", "intensity": 0})";
  const Scene scene = load(lit_square(odd, light_node(0) + "," + light_node(1), "1, 2").str());
  EXPECT_EQ(scene.punctual_lights.size(), 1u);
  EXPECT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(refusal(lit_square(R"({"type": "area"})", light_node(0), "1").str()).find("/lights/0/type"),
            std::string::npos);

  const std::string named = R"({"type": "point", "intensity": 0, "extras": {"emission_spectrum": "cie:A"}})";
  EXPECT_NE(refusal(lit_square(named, light_node(0), "1").str()).find("emits nothing"), std::string::npos);
  const std::string flat = light_node(0, R"(, "scale": [1, 1, 0])");
  EXPECT_NE(refusal(lit_square(R"({"type": "directional"})", flat, "1").str()).find("/nodes/1"),
            std::string::npos);
  EXPECT_EQ(load(lit_square(R"({"type": "point"})", flat, "1").str()).punctual_lights.size(), 1u);
  EXPECT_NE(refusal(lit_square(R"({"type": "point", "intensity": -1})", light_node(0), "1").str())
                .find("intensity"),
            std::string::npos);
}

constexpr const char* kCamera =
    R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])";

/// A file without any light gets a sky and says so; one with a lamp, or with a light that only shines from a
/// point, does not.
TEST_F(GltfTest, DefaultSky) {
  SquareFile file;
  file.nodes = R"([{"mesh": 0}, {"camera": 0}])";
  file.roots = "[0, 1]";
  file.more = kCamera;
  const Scene dark = load_gltf(write("dark.gltf", file.str()));
  ASSERT_TRUE(dark.environment);
  EXPECT_EQ(dark.emission_names, (std::vector<std::string>{"cie:D65"}));
  ASSERT_EQ(dark.warnings.size(), 1u);
  EXPECT_NE(dark.warnings[0].find("dark.gltf emits light: lit by an overcast sky"), std::string::npos);
  const Scene warm = load_gltf(write("dark.gltf", file.str()), {.emitters = {{"", "cie:A"}}});
  EXPECT_EQ(warm.emission_names, (std::vector<std::string>{"cie:A"}));

  // A picture of itself lights nothing.
  file.materials = R"([{"extensions": {"KHR_materials_unlit": {}}}])";
  file.primitive += R"(, "material": 0)";
  EXPECT_TRUE(load_gltf(write("unlit.gltf", file.str())).environment);

  SquareFile lit = lit_square(R"({"type": "point"})", light_node(0) + R"(, {"camera": 0})", "1, 2");
  lit.more += kCamera;
  EXPECT_FALSE(load_gltf(write("lit.gltf", lit.str())).environment);
}

}  // namespace
}  // namespace photopic
