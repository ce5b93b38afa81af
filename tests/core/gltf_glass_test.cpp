#include "gltf_fixture.h"

namespace photopic {
namespace {

constexpr const char* kPane =
    R"({"name": "pane", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})";

constexpr const char* kSolid =
    R"({"name": "lens", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
    "KHR_materials_volume": {"thicknessFactor": 1}}, "pbrMetallicRoughness": {"metallicFactor": 0}})";

/// Faces of a tetrahedron whose corners are split between them, as exporters of flat shading write them.
/// @param first, last of its four faces @param size negative: they look inwards
std::vector<float> tetrahedron_faces(std::size_t first, std::size_t last, float size = 1) {
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int turns[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::vector<float> positions;
  for (std::size_t f = first; f < last; ++f)
    for (int corner : turns[f])
      for (float x : corners[corner]) positions.push_back(size * x);
  return positions;
}

/// Makes these triangles the mesh, or its next primitive.
void add_part(SquareFile& file, const std::vector<float>& positions, int material = 0) {
  const int accessor = file.add(positions, 5126, "VEC3", positions.size() / 3);
  const bool is_first = file.primitive.find("indices") != std::string::npos;
  file.primitive = (is_first ? "" : file.primitive + "}, {") +
                   fmt::format(R"("attributes": {{"POSITION": {}}}, "material": {})", accessor, material);
}

/// @param faces of its four
SquareFile tetrahedron(const std::string& material, std::size_t faces = 4) {
  const std::vector<float> positions = tetrahedron_faces(0, faces);
  SquareFile file;
  add_part(file, positions);
  file.materials = "[" + material + "]";
  return file;
}

TEST_F(GltfTest, ClosedGlassIsSolidWhereAsked) {
  const GltfOptions asked{.solid_glass = true};
  EXPECT_TRUE(load(tetrahedron(kPane).str()).materials[0].thin_walled);
  const Scene solid = load(tetrahedron(kPane).str(), asked);
  EXPECT_FALSE(solid.materials[0].thin_walled);
  EXPECT_TRUE(solid.warnings.empty());

  const Scene open = load(tetrahedron(kPane, 3).str(), asked);
  EXPECT_TRUE(open.materials[0].thin_walled);
  ASSERT_EQ(open.warnings.size(), 1u);
  EXPECT_NE(open.warnings[0].find("\"pane\" stays thin-walled: /meshes/0"), std::string::npos)
      << open.warnings[0];

  // A face turned over is no closed mesh: what is inside?
  SquareFile turned = tetrahedron(kPane);
  const std::vector<std::uint16_t> indices = {0, 2, 1, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  turned.primitive += fmt::format(R"(, "indices": {})", turned.add(indices, 5123, "SCALAR", 12));
  EXPECT_TRUE(load(turned.str(), asked).materials[0].thin_walled);
}

TEST_F(GltfTest, ToAskForSolidGlassWhereNoneIsUndecidedHasNoEffect) {
  const GltfOptions asked{.solid_glass = true};
  EXPECT_EQ(load(SquareFile().str(), asked).warnings,
            std::vector<std::string>{"--solid-glass has no effect: no material transmits"});
  EXPECT_EQ(load(tetrahedron(kSolid).str(), asked).warnings,
            std::vector<std::string>{
                "--solid-glass has no effect: all glass of the meshes says itself whether it is solid"});
}

TEST_F(GltfTest, GlassThatSaysWhichItIsStays) {
  const GltfOptions asked{.solid_glass = true};
  const std::string sheet =
      R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {}}})";
  EXPECT_TRUE(load(tetrahedron(sheet).str(), asked).materials[0].thin_walled);
  const auto with_extras = [&](const std::string& extras, std::size_t faces) {
    std::string material = kPane;
    material.insert(material.size() - 1, ", \"extras\": " + extras);
    return load(tetrahedron(material, faces).str(), asked);
  };
  EXPECT_TRUE(with_extras(R"({"solid": false})", 4).materials[0].thin_walled);
  const Scene open = with_extras(R"({"solid": true, "priority": -3})", 3);
  EXPECT_FALSE(open.materials[0].thin_walled);
  EXPECT_EQ(open.materials[0].priority, -3);
}

TEST_F(GltfTest, SolidGlassThatEnclosesNothingIsWarnedOf) {
  const auto only_warning = [&](const SquareFile& file) {
    const Scene scene = load(file.str());
    EXPECT_EQ(scene.warnings.size(), 1u);
    return scene.warnings.empty() ? std::string() : scene.warnings.front();
  };
  const std::string open = only_warning(tetrahedron(kSolid, 3));
  EXPECT_NE(open.find("\"lens\" is not closed in /meshes/0"), std::string::npos) << open;

  SquareFile turned = tetrahedron(kSolid, 3);
  std::vector<float> last = tetrahedron_faces(3, 4);
  for (std::size_t i = 0; i < 3; ++i) std::swap(last[i], last[3 + i]);
  add_part(turned, last);
  EXPECT_NE(only_warning(turned).find("not closed"), std::string::npos);

  SquareFile inside_out;
  inside_out.materials = fmt::format("[{}]", kSolid);
  add_part(inside_out, tetrahedron_faces(0, 4, -1));
  const std::string inwards = only_warning(inside_out);
  EXPECT_NE(inwards.find("\"lens\" is inside out in /meshes/0"), std::string::npos) << inwards;
  // A mirror turns the faces with the mesh.
  inside_out.nodes = R"([{"mesh": 0, "scale": [1, 1, -1]}])";
  EXPECT_NE(only_warning(inside_out).find("inside out"), std::string::npos);

  // Water that leans on a glass without walls of its own.
  SquareFile water = tetrahedron(std::string(kSolid) + ", " + kSolid);
  add_part(water, {0, 0, 0.5f, 0.5f, 0, 0.5f, 0, 0.5f, 0.5f}, 1);
  EXPECT_NE(only_warning(water).find("not closed"), std::string::npos);
}

/// A tetrahedron and another, of half its size and inside out, that stands where it is told.
SquareFile glass_and_bubble(const std::string& materials, int bubble_material,
                            const std::string& bubble_node) {
  SquareFile file = tetrahedron(kSolid);
  const std::vector<float> positions = tetrahedron_faces(0, 4, -0.5f);
  const int accessor = file.add(positions, 5126, "VEC3", positions.size() / 3);
  file.primitive +=
      fmt::format(R"(}}]}}, {{"primitives": [{{"attributes": {{"POSITION": {}}}, "material": {})", accessor,
                  bubble_material);
  file.materials = materials;
  file.nodes = fmt::format(R"([{{"mesh": 0, "translation": [0, 0, 5]}}, {{"mesh": 1, {}}}])", bubble_node);
  file.roots = "[0, 1]";
  return file;
}

TEST_F(GltfTest, BubblesOfTheirOwnMeshLookInwardsInTheirGlassAlone) {
  const auto warnings = [&](int material, const std::string& node) {
    return load(glass_and_bubble(fmt::format("[{0}, {0}]", kSolid), material, node).str()).warnings;
  };
  const std::string inside = R"("translation": [0.6, 0.6, 5.6])";
  EXPECT_EQ(warnings(0, inside), std::vector<std::string>());
  EXPECT_EQ(warnings(0, R"("translation": [0.6, 0.6, 0.6])").size(), 1u);
  EXPECT_EQ(warnings(0, R"("translation": [0.6, 0.6, 6.1])").size(), 1u);  // it stands out of the glass
  EXPECT_EQ(warnings(1, inside).size(), 1u);                               // in another glass it is no bubble
}

TEST_F(GltfTest, SoundSolidGlassIsNotWarnedOf) {
  const auto expect_quiet = [&](const SquareFile& file) {
    EXPECT_EQ(load(file.str()).warnings, std::vector<std::string>());
  };
  SquareFile file = tetrahedron(kSolid);
  expect_quiet(file);
  file.nodes = R"([{"mesh": 0, "scale": [-1, 2, 0.5]}])";
  expect_quiet(file);
  file.nodes = R"([{"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0]}])", file.roots = "[0, 1]";
  expect_quiet(file);
  add_part(file, tetrahedron_faces(0, 4, -0.5f));  // its hollow, as it were
  expect_quiet(file);
  expect_quiet(tetrahedron(kPane, 3));

  // A pane's label, of another material, closes it.
  SquareFile label = tetrahedron(std::string(kSolid) + R"(, {"name": "label"})", 3);
  add_part(label, tetrahedron_faces(3, 4), 1);
  expect_quiet(label);

  // Seams are where a sine of 2π is not 0, or rounding tells two places apart.
  SquareFile seam = tetrahedron(kSolid, 3);
  std::vector<float> last = tetrahedron_faces(3, 4);
  for (float& x : last) x = x == 0 ? -2.4e-16f : std::nextafter(x, 0.0f);
  add_part(seam, last);
  expect_quiet(seam);
}

TEST_F(GltfTest, SolidGlassThatAlphaUncoversIsWarnedOf) {
  const auto warnings_of = [&](const std::string& more, double alpha, bool solid = true) {
    const std::string material = fmt::format(
        R"({{"name": "lens", {}, "pbrMetallicRoughness": {{"metallicFactor": 0, "baseColorFactor": [1, 1, 1, {}]}},
        "extensions": {{"KHR_materials_transmission": {{"transmissionFactor": 1}}}}}})",
        more, alpha);
    return load(tetrahedron(material).str(), {.solid_glass = solid}).warnings;
  };
  const std::string blend = R"("alphaMode": "BLEND")", mask = R"("alphaMode": "MASK")";
  const std::vector<std::string> warnings = warnings_of(blend, 0.9);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("the solid glass \"lens\" has alpha"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("alphaMode to OPAQUE"), std::string::npos) << warnings[0];
  EXPECT_EQ(warnings_of(mask, 0.4).size(), 1u);
  for (const auto& covered : {warnings_of(blend, 1), warnings_of(mask, 0.5), warnings_of(blend, 0.9, false),
                              warnings_of(R"("alphaMode": "OPAQUE")", 0.5)})
    EXPECT_EQ(covered, std::vector<std::string>());
}

TEST_F(GltfTest, WhatGlassDoesNotWearIsWarnedOf) {
  SquareFile file;
  const auto warnings_of = [&](const std::string& pbr, double transmission) {
    file.materials = fmt::format(
        R"([{{"name": "car", "pbrMetallicRoughness": {{{}}}, "extensions": {{
        "KHR_materials_transmission": {{"transmissionFactor": {}}},
        "KHR_materials_clearcoat": {{"clearcoatFactor": 1}}, "KHR_materials_anisotropy": {{"anisotropyStrength": 0.5}}}}}}])",
        pbr, transmission);
    return load(file.str()).warnings;
  };
  EXPECT_EQ(
      warnings_of(R"("metallicFactor": 0)", 1),
      std::vector<std::string>{"material \"car\": its glass is rendered without clearcoat and anisotropy"});
  EXPECT_EQ(warnings_of(R"("metallicFactor": 0.5)", 0.5).size(), 1u);
  EXPECT_TRUE(warnings_of(R"("metallicFactor": 0)", 0).empty());
  EXPECT_TRUE(warnings_of(R"("metallicFactor": 1)", 1).empty());  // no glass is left

  file.materials =
      R"([{"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
      "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1]}}, "pbrMetallicRoughness": {"metallicFactor": 0}}])";
  EXPECT_EQ(load(file.str()).warnings,
            std::vector<std::string>{"material 0: its glass is rendered without sheen"});
}

TEST_F(GltfTest, AttenuationUnderDiffuseTransmissionIsWarnedOfOnce) {
  SquareFile file;
  const auto warnings_of = [&](const std::string& volume, const std::string& more = "") {
    const std::string material = fmt::format(
        R"({{"name": "wax", "extensions": {{"KHR_materials_diffuse_transmission": {{"diffuseTransmissionFactor": 1}},
        "KHR_materials_volume": {{{}}}{}}}}})",
        volume, more);
    file.materials = fmt::format("[{0}, {0}]", material);
    return load(file.str()).warnings;
  };
  const std::string color = R"("thicknessFactor": 1, "attenuationDistance": 0.1, "attenuationColor": )";
  const std::vector<std::string> warnings = warnings_of(color + "[0.9, 0.5, 0.1]");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].starts_with("material \"wax\" and 1 more: KHR_materials_volume ")) << warnings[0];
  EXPECT_EQ(warnings_of(color + "[0.1, 0.1, 0.1]").size(), 1u);
  for (const auto& nothing_ignored :
       {warnings_of(R"("thicknessFactor": 1)"), warnings_of(color + "[1, 1, 1]"),
        warnings_of(R"("attenuationDistance": 0.1, "attenuationColor": [0.1, 0.1, 0.1])"),
        warnings_of(color + "[0.1, 0.1, 0.1]", R"(, "KHR_materials_unlit": {})")})
    EXPECT_EQ(nothing_ignored, std::vector<std::string>());
}

TEST_F(GltfTest, WrongExtrasOfGlassAreRefused) {
  SquareFile file;
  for (const char* wrong : {R"({"solid": 1})", R"({"solid": "yes"})", R"({"priority": 1.5})",
                            R"({"priority": "high"})", R"({"priority": 1e9})", R"({"priority": true})"}) {
    file.materials = fmt::format("[{{\"extras\": {}}}]", wrong);
    EXPECT_NE(refusal(file.str()).find("#/materials/0/extras/"), std::string::npos) << wrong;
  }
}

}  // namespace
}  // namespace photopic
