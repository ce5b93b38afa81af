#include "core/gltf_loader.h"

#include "core/bsdf/shading_material.h"
#include "core/gltf/material.h"
#include "gltf_fixture.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

constexpr const char* kCamera =
    R"(, "cameras": [{"type": "perspective", "name": "near", "perspective": {"yfov": 1.0, "aspectRatio": 2.0}},
  {"type": "perspective", "name": "far", "perspective": {"yfov": 0.5}, "extras": {"resolution": [30, 20]}}])";

Vec3f world_position(const Scene& scene, std::size_t i) {
  return to_float(to_double(scene.geometry.positions.at(i)) + scene.origin);
}

void expect_near(Vec3f a, Vec3f b, float tolerance = 1e-5f) {
  EXPECT_LE(max_abs(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST_F(GltfTest, SquareFacesForward) {
  const Scene scene = load(SquareFile{}.str());
  ASSERT_EQ(scene.geometry.triangles.size(), 2u);
  expect_near(area_vector(scene, 0), {0, 0, 1});
  expect_near(area_vector(scene, 1), {0, 0, 1});
  EXPECT_EQ(scene.origin, (Vec3d{0.5, 0.5, 0.0}));
  expect_near(world_position(scene, 2), {1, 1, 0});
  EXPECT_TRUE(scene.geometry.normals.empty());          // nothing is stored that no primitive has
  EXPECT_EQ(scene.geometry.shapes.at(0).material, 1u);  // glTF's default stands after the file's own
  EXPECT_EQ(scene.materials.at(1).metallic, 1.0f);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(GltfTest, TransformsMultiplyFromParentToChild) {
  SquareFile file;
  // A quarter turn about z carries (1, 1, 0)·(2, 3, 1) = (2, 3, 0) to (−3, 2, 0); its parent then moves it.
  file.nodes =
      R"([{"mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 3, 1]},
                   {"children": [0], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,20,30,1]}])";
  file.roots = "[1]";
  const Scene scene = load(file.str());
  expect_near(world_position(scene, 2), {7, 22, 30}, 1e-4f);
  expect_near(area_vector(scene, 0), {0, 0, 6}, 1e-4f);
}

TEST_F(GltfTest, RotationsNeedNotBeNormalised) {
  SquareFile file;
  file.nodes = R"([{"mesh": 0, "rotation": [0, 0, 3, 3]}])";
  expect_near(world_position(load(file.str()), 1), {0, 1, 0});
}

TEST_F(GltfTest, MirroringKeepsTheFront) {
  SquareFile file;
  file.nodes = R"([{"mesh": 0, "scale": [-1, 1, 1]}])";
  file.primitive = R"("attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1)";
  file.positions = {0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  const Scene scene = load(file.str());
  EXPECT_GT(area_vector(scene, 0).z, 0.0f);
  expect_near(scene.geometry.normals[1], normalize(Vec3f{-1, 0, 1}));
}

TEST_F(GltfTest, NormalsStayPerpendicularUnderUnevenScale) {
  SquareFile file;
  file.nodes = R"([{"mesh": 0, "scale": [1, 4, 0.5], "rotation": [0.3, -0.2, 0.5, 0.7]}])";
  file.primitive = R"("attributes": {"POSITION": 0, "NORMAL": 2}, "indices": 1)";
  file.positions = {0, 0, 0, 1, 0, 1, 1, 1, 1, 0, 1, 0};  // the plane x = z, normal (−1, 0, 1)
  const std::vector<float> normals = {-1, 0, 1, -1, 0, 1, -1, 0, 1, -1, 0, 1};
  file.tail = bytes_of(normals);
  file.accessors += R"(, {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3"})";
  file.views += R"(, {"buffer": 0, "byteOffset": 60, "byteLength": 48})";
  const Scene scene = load(file.str());
  expect_near(scene.geometry.normals[0], normalize(area_vector(scene, 0)));
}

TEST_F(GltfTest, SharedMeshesAreBaked) {
  SquareFile file;
  file.nodes =
      R"([{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}, {"mesh": 0, "translation": [0, 0, 1e6]}])";
  file.roots = "[0, 1, 2]";
  const Scene scene = load(file.str());
  EXPECT_EQ(scene.geometry.shapes.size(), 1u);  // one of each material
  EXPECT_EQ(scene.geometry.triangles.size(), 6u);
  EXPECT_EQ(scene.geometry.positions.capacity(), scene.geometry.positions.size() + 1);  // Embree's
  expect_near(world_position(scene, 6), {6, 1, 0});
  EXPECT_EQ(scene.origin, (Vec3d{3.0, 0.5, 5e5}));
}

TEST_F(GltfTest, FarFromZeroFloatsStayExact) {
  SquareFile file;
  file.nodes = R"([{"mesh": 0, "translation": [1e7, 0, 0], "scale": [0.001, 0.001, 0.001]}])";
  const Scene scene = load(file.str());
  EXPECT_NEAR(area_vector(scene, 0).z, 1e-6f, 1e-11f);
}

TEST_F(GltfTest, StripsAndFansWindLikeTheirFirstTriangle) {
  for (const char* mode : {"5", "6"}) {
    SquareFile file;
    file.primitive = std::string(R"("attributes": {"POSITION": 0}, "mode": )") + mode;
    if (mode[0] == '5') file.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const Scene scene = load(file.str());
    ASSERT_EQ(scene.geometry.triangles.size(), 2u) << mode;
    expect_near(area_vector(scene, 0) + area_vector(scene, 1), {0, 0, 2});
    EXPECT_GT(area_vector(scene, 0).z * area_vector(scene, 1).z, 0.0f);
  }
}

TEST_F(GltfTest, WithoutIndicesEveryThreeVerticesAreATriangle) {
  SquareFile file;
  file.primitive = R"("attributes": {"POSITION": 0})";
  const Scene scene = load(file.str());
  EXPECT_EQ(scene.geometry.triangles.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);  // of the fourth vertex
}

TEST_F(GltfTest, QuantisedPositions) {
  SquareFile file;
  file.accessors =
      R"({"bufferView": 0, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC3"}, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"})";
  file.views =
      R"({"buffer": 0, "byteLength": 16, "byteStride": 4}, {"buffer": 0, "byteOffset": 16, "byteLength": 12})";
  file.positions.clear();
  file.indices.clear();
  file.tail = std::string("\0\0\0\0\xff\0\0\0\xff\xff\0\0\0\xff\0\0", 16) +
              bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3});
  expect_near(area_vector(load(file.str()), 0), {0, 0, 1});
}

TEST_F(GltfTest, SparseIndicesNeedNoView) {
  SquareFile file;
  file.accessors =
      R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}, {"componentType": 5123, "count": 3, "type": "SCALAR",
    "sparse": {"count": 2, "indices": {"bufferView": 1, "byteOffset": 2, "componentType": 5123}, "values": {"bufferView": 1, "byteOffset": 2}}})";
  const Scene scene = load(file.str());  // elements 1 and 2 become 1 and 2
  ASSERT_EQ(scene.geometry.triangles.size(), 1u);
  EXPECT_EQ(scene.geometry.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST_F(GltfTest, ExternalBuffersByEncodedNames) {
  SquareFile file;
  file.uri = "square%20%C3%A4+1.bin";
  write("square \xC3\xA4+1.bin", file.bytes() + "more than needed");
  EXPECT_EQ(load(file.str()).geometry.triangles.size(), 2u);
}

TEST_F(GltfTest, GlbMayTrailBytes) {
  SquareFile file;
  std::string json = file.str();
  json.replace(json.find("\"uri\""), json.rfind('"') - json.find("\"uri\"") + 1, "\"name\": \"bin\"");
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::string bin = file.bytes();
  const auto word = [](std::size_t n) { return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(n)}); };
  const std::string glb = "glTF" + word(2) + word(12 + 8 + json.size() + 8 + bin.size()) + word(json.size()) +
                          "JSON" + json + word(bin.size()) + std::string("BIN\0", 4) + bin;
  EXPECT_EQ(load_gltf(write("a.glb", glb + "trailing")).geometry.triangles.size(), 2u);
  EXPECT_NE(message([&] { load_gltf(write("b.glb", glb.substr(0, glb.size() - 1))); }).find("cut short"),
            std::string::npos);
}

TEST_F(GltfTest, CamerasByNameAndResolution) {
  SquareFile file;
  file.nodes =
      R"([{"mesh": 0}, {"camera": 0, "translation": [0, 0, 4]}, {"camera": 1, "translation": [5, 0, 0], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476], "scale": [2, 2, 2]}])";
  file.roots = "[0, 1, 2]";
  file.more = kCamera;
  const Camera first = load(file.str()).camera;
  EXPECT_EQ(first.width, 640);
  EXPECT_EQ(first.height, 320);
  expect_near(first.position, {-0.5f, -0.5f, 4});

  const Camera far = load(file.str(), {.camera = "far"}).camera;
  EXPECT_EQ(far.width, 30);
  EXPECT_FLOAT_EQ(far.tan_half_yfov, std::tan(0.25f));
  expect_near(far.back, {1, 0, 0});  // looks down −x after a quarter turn about y
  expect_near(far.up, {0, 1, 0});
  expect_near(far.ray(15.0f, 10.0f).direction, {-1, 0, 0});
  EXPECT_EQ(load(file.str(), {.camera = "far", .width = 8, .height = 4}).camera.width, 8);
  EXPECT_NE(refusal(file.str(), {.camera = "fra"}).find("\"near\", \"far\""), std::string::npos);
}

/// Blender writes them for each Specular IOR Level above 0.5.
TEST_F(GltfTest, SpecularColorsAboveOneAreKept) {
  SquareFile file;
  file.primitive += R"(, "material": 0)";
  file.materials = R"([{"extensions": {"KHR_materials_specular": {"specularColorFactor": [3, 1.5, 1.5]}}}])";
  const Scene scene = load(file.str());
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(scene.warnings, std::vector<std::string>());
  EXPECT_EQ(m.specular_scale, 3.0f);
  EXPECT_EQ(m.specular_color_factor, (Vec3f{1.0f, 0.5f, 0.5f}));
  const Spectrum expected = reflectance_from_rgb({1.0, 0.5, 0.5});
  for (double lambda : {450.0, 550.0, 650.0}) {
    const Surface surface(m);
    const ShadingMaterial<1> shaded(surface, SampledSpectrum<1>(static_cast<float>(lambda)));
    EXPECT_NEAR(shaded.specular_color()[0], 3.0 * evaluate(expected, lambda), 1e-5);
  }
}

TEST_F(GltfTest, MaterialFactors) {
  SquareFile file;
  file.primitive += R"(, "material": 0)";
  file.materials =
      R"([{"name": "glass", "doubleSided": true, "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0.25, "roughnessFactor": 0.75},
    "extensions": {"KHR_materials_ior": {"ior": 1.33}, "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0, 0]},
    "KHR_materials_transmission": {"transmissionFactor": 0.9}, "KHR_materials_volume": {"thicknessFactor": 0.1, "attenuationDistance": 2, "attenuationColor": [0.25, 0.25, 0.25]}}}])";
  const Material m = load(file.str()).materials.at(0);
  EXPECT_EQ(m.name, "glass");
  EXPECT_EQ(std::get<ConstantSpectrum>(m.base_color).value, 0.5);
  EXPECT_FLOAT_EQ(m.metallic, 0.25f);
  EXPECT_FLOAT_EQ(m.roughness, 0.75f);
  EXPECT_FLOAT_EQ(m.ior, 1.33f);
  EXPECT_FLOAT_EQ(m.specular, 0.5f);
  EXPECT_GT(evaluate(m.specular_color, 650), 10 * evaluate(m.specular_color, 500));
  EXPECT_FLOAT_EQ(m.transmission, 0.9f);
  EXPECT_FALSE(m.thin_walled);
  EXPECT_FLOAT_EQ(m.attenuation_distance, 2.0f);
  EXPECT_EQ(std::get<ConstantSpectrum>(m.attenuation_color).value, 0.25);
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.emission_spectrum, -1);
}

TEST_F(GltfTest, MaterialExtensions) {
  SquareFile file;
  file.materials =
      R"([{"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25},
    "KHR_materials_sheen": {"sheenColorFactor": [0.25, 0.25, 0.25], "sheenRoughnessFactor": 0.75},
    "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 2},
    "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.5, "iridescenceThicknessMaximum": 600},
    "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.125, "diffuseTransmissionColorFactor": [0.5, 0.5, 0.5]}}},
    {"extensions": {"KHR_materials_ior": {"ior": 1.6}, "KHR_materials_dispersion": {"dispersion": 0.5},
    "KHR_materials_transmission": {"transmissionFactor": 1}}}, {}])";
  const Scene scene = load(file.str());
  const MaterialExtensions& x = scene.materials.at(0).extensions;
  EXPECT_EQ(x.clearcoat, 0.5f);
  EXPECT_EQ(x.clearcoat_roughness, 0.25f);
  EXPECT_EQ(std::get<ConstantSpectrum>(x.sheen_color).value, 0.25);
  EXPECT_EQ(x.sheen_roughness, 0.75f);
  EXPECT_EQ(x.anisotropy, 0.5f);
  EXPECT_EQ(x.anisotropy_rotation, 2.0f);
  EXPECT_EQ(x.iridescence, 1.0f);
  EXPECT_EQ(x.iridescence_ior, 1.5f);
  EXPECT_EQ(x.iridescence_thickness, 600.0f);
  EXPECT_EQ(x.diffuse_transmission, 0.125f);
  EXPECT_EQ(std::get<ConstantSpectrum>(x.diffuse_transmission_color).value, 0.5);
  EXPECT_TRUE(scene.materials.at(0).needs_tangents);
  const DielectricIndex glass = scene.materials.at(1).extensions.dispersion.value();
  EXPECT_NEAR(abbe_number(glass), 40.0, 0.05);
  EXPECT_NEAR(refractive_index(glass, 587.56), 1.6, 1e-4);
  EXPECT_FALSE(scene.materials.at(2).extensions.any());
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(GltfTest, MetalsAndGlassesByExtras) {
  SquareFile file;
  file.materials =
      R"([{"extras": {"conductor": "Au"}}, {"extras": {"glass": "SF10"}}, {"extras": {"glass": {"cauchy": [1.5, 0.004]}}}])";
  const Scene scene = load(file.str());
  EXPECT_TRUE(scene.materials.at(0).extensions.conductor);
  file.materials =  // all metal: nothing transmits
      R"([{"extras": {"conductor": "Au"}, "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}])";
  EXPECT_TRUE(load(file.str()).materials.at(0).extensions.conductor);
  const Material& glass = scene.materials.at(1);
  EXPECT_NEAR(glass.ior, 1.72825, 1e-5);
  EXPECT_EQ(glass.transmission, 1.0f);
  EXPECT_FALSE(glass.thin_walled);
  EXPECT_NEAR(refractive_index(scene.materials.at(2).extensions.dispersion.value(), 500.0), 1.516, 1e-9);
  for (const char* wrong :
       {R"({"conductor": "gold"})", R"({"conductor": 1})", R"({"glass": "K9"})", R"({"glass": {"x": 1}})",
        R"({"glass": {"cauchy": [1.5]}})", R"({"glass": {"cauchy": [0.5, "x"]}})"}) {
    file.materials = fmt::format("[{{\"extras\": {}}}]", wrong);
    EXPECT_NE(refusal(file.str()).find("#/materials/0/extras/"), std::string::npos) << wrong;
  }
}

TEST_F(GltfTest, ReflectanceSpectraByExtras) {
  SquareFile file;
  write("paint.csv", "400,0.1\n700,0.4\n");
  file.materials =
      R"([{"extras": {"reflectance_spectrum": "paint.csv"}}, {"extras": {"reflectance_spectrum": {"nm": [400, 700], "value": [0.1, 0.4]}}}])";
  const Scene scene = load(file.str());
  for (const int i : {0, 1}) {
    EXPECT_NEAR(evaluate(scene.materials.at(i).base_color, 500), 0.2, 1e-12);
    EXPECT_NEAR(evaluate(scene.materials.at(i).base_color, 800), 0.4, 1e-12);
  }
}

/// Two emissive squares, "a" white of 3 cd/m² and "b" with a lamp of luminance 0.7152·10 cd/m² (green).
SquareFile two_lamps(const std::string& extras_of_b) {
  SquareFile file;
  file.primitive += R"(, "material": 0}, {"attributes": {"POSITION": 0}, "indices": 1, "material": 1)";
  file.materials =
      R"([{"name": "a", "emissiveFactor": [0.5, 0.5, 0.5], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 6}}},
    {"name": "b", "emissiveFactor": [0, 1, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 10}})" +
      extras_of_b + "}]";
  return file;
}

TEST_F(GltfTest, LampsKeepTheirLuminance) {
  const Scene scene = load(two_lamps(R"(, "extras": {"emission_spectrum": "cie:FL11"})").str());
  ASSERT_EQ(scene.emission_spectra.size(), 2u);
  EXPECT_EQ(scene.emission_names, (std::vector<std::string>{"cie:D65", "cie:FL11"}));
  EXPECT_EQ(scene.materials[0].emission_spectrum, 0);
  EXPECT_EQ(scene.materials[1].emission_spectrum, 1);
  EXPECT_NEAR(scene.materials[0].emission_luminance, 3.0, 1e-4);
  EXPECT_NEAR(scene.materials[1].emission_luminance, 7.152, 1e-2);
  for (const auto& spectrum : scene.emission_spectra)
    EXPECT_NEAR(emission_xyz(spectrum, Observer::cie1931()).y, 1.0, 1e-9);
}

TEST_F(GltfTest, ColouredLampsAreTheirColourOnD65) {
  const Scene scene = load(two_lamps("").str());
  const Xyz xyz = emission_xyz(scene.emission_spectra.at(1), Observer::cie1931());
  const Xyz green = linear_srgb_to_xyz({0, 1, 0});
  EXPECT_NEAR(xyz.x / xyz.y, green.x / green.y, 5e-3);
  EXPECT_NEAR(xyz.z / xyz.y, green.z / green.y, 5e-3);
}

TEST_F(GltfTest, OverridesByNameWinOverAll) {
  const std::string file = two_lamps("").str();
  const Scene scene = load(file, {.emitters = {{"b", "cie:FL2"}, {"", "line:532"}, {"", "cie:FL11"}}});
  EXPECT_EQ(scene.emission_names.at(scene.materials[0].emission_spectrum), "cie:FL11");
  EXPECT_EQ(scene.emission_names.at(scene.materials[1].emission_spectrum), "cie:FL2");
  EXPECT_NEAR(scene.materials[0].emission_luminance, 3.0, 1e-4);
  const Scene same = load(file, {.emitters = {{"", "cie:FL11"}}});
  EXPECT_EQ(same.emission_spectra.size(), 1u);
  EXPECT_EQ(same.materials[1].emission_spectrum, 0);
}

TEST_F(GltfTest, OverridesMustNameAnEmitter) {
  const std::string text = refusal(two_lamps("").str(), {.emitters = {{"c", "cie:FL2"}}});
  EXPECT_NE(text.find("\"a\", \"b\""), std::string::npos) << text;
}

/// Whole numbers of more than 32 bits keep their value wherever a material holds them.
TEST_F(GltfTest, LargeWholeNumbersAreNotCut) {
  SquareFile file;
  file.primitive += R"(, "material": 0)";
  file.materials =
      R"([{"emissiveFactor": [1, 1, 1], "extras": {"emission_spectrum": {"nm": [400, 700], "value": [4294967297, 4294967297]}},
           "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3000000000}}}])";
  const Scene scene = load(file.str());
  EXPECT_NEAR(scene.materials[0].emission_luminance, 3e9, 3e3);
  const auto& spectrum = scene.emission_spectra.at(0);
  EXPECT_NEAR(spectrum(450.0), spectrum(650.0), 1e-9 * spectrum(450.0));
}

TEST_F(GltfTest, DarkLampsAreRefused) {
  for (const char* spectrum :
       {R"({"nm": [400, 700], "value": [0, 0]})", R"({"nm": [900, 950], "value": [1, 1]})",
        R"({"nm": [400, 700], "value": [1, -1]})"}) {
    const std::string text =
        refusal(two_lamps(fmt::format(R"(, "extras": {{"emission_spectrum": {}}})", spectrum)).str());
    EXPECT_NE(text.find("#/materials/1/extras/emission_spectrum"), std::string::npos) << text;
  }
  EXPECT_NE(refusal(two_lamps("").str(), {.emitters = {{"", "line:900"}}}).find("line:900"),
            std::string::npos);
  SquareFile black;
  black.primitive += R"(, "material": 0)";
  black.materials = R"([{"extras": {"emission_spectrum": "cie:A"}}])";
  EXPECT_NE(refusal(black.str()).find("#/materials/0"), std::string::npos);
}

TEST_F(GltfTest, CornellBox) {
  const Scene scene = load_gltf(std::filesystem::path(PHOTOPIC_SCENES) / "cornell-box" / "scene.gltf");
  EXPECT_EQ(scene.geometry.triangles.size(), 32u);  // 5 walls, 2 × 5 faces, the lamp
  EXPECT_EQ(scene.geometry.shapes.size(), 4u);      // white, red, green, the lamp
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(scene.camera.width, 256);
  EXPECT_NEAR(scene.camera.tan_half_yfov, 0.0125 / 0.035, 1e-6);
  expect_near(to_float(to_double(scene.camera.position) + scene.origin), {0.278f, 0.273f, -0.8f});
  expect_near(scene.camera.back, {0, 0, -1});

  const Material& white = scene.materials.at(0);
  EXPECT_EQ(white.name, "white");
  EXPECT_NEAR(evaluate(white.base_color, 400), 0.343, 1e-9);
  EXPECT_EQ(white.specular, 0.0f);
  EXPECT_EQ(white.metallic, 0.0f);

  // The lamp: 130 mm × 105 mm, facing down.
  ASSERT_EQ(scene.emission_names, std::vector<std::string>{"cie:FL11"});
  for (const Shape& shape : scene.geometry.shapes) {
    if (scene.materials[shape.material].emission_spectrum < 0) continue;
    EXPECT_GT(scene.materials[shape.material].emission_luminance, 1.0f);
    const Vec3f area =
        (area_vector(scene, shape.first_triangle) + area_vector(scene, shape.first_triangle + 1)) * 0.5f;
    expect_near(area, {0, -0.130f * 0.105f, 0}, 1e-7f);
  }
}

TEST_F(GltfTest, GlassAndMetalIsClosedAndPointsOutwards) {
  const Scene scene = load_gltf(std::filesystem::path(PHOTOPIC_SCENES) / "glass-and-metal" / "scene.glb");
  EXPECT_TRUE(scene.warnings.empty());
  for (const Shape& shape : scene.geometry.shapes) {
    const Material& material = scene.materials[shape.material];
    if (material.transmission == 0.0f && material.metallic == 0.0f) continue;
    // Closed: the area vectors cancel. Outwards: the divergence theorem's volume is positive.
    Vec3d sum;
    double volume = 0.0, area = 0.0;
    for (std::size_t i = shape.first_triangle; i < shape.first_triangle + shape.triangle_count; ++i) {
      const Vec3d a = to_double(area_vector(scene, i));
      sum = sum + a;
      area += length(a);
      volume += dot(a, to_double(scene.geometry.positions[scene.geometry.triangles[i][0]])) / 6.0;
    }
    EXPECT_LT(length(sum), 1e-6 * area) << material.name;
    EXPECT_GT(volume, 0.0) << material.name;
  }
}

}  // namespace
}  // namespace photopic
