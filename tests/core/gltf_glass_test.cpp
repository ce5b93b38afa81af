#include "gltf_fixture.h"

namespace photopic {
namespace {

constexpr const char* kPane =
    R"({"name": "pane", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})";

/// A tetrahedron whose corners are split between its faces, as exporters of flat shading write them.
/// @param faces of its four
SquareFile tetrahedron(const std::string& material, std::size_t faces = 4) {
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int turns[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::vector<float> positions;
  for (std::size_t f = 0; f < faces; ++f)
    for (int corner : turns[f]) positions.insert(positions.end(), corners[corner], corners[corner] + 3);
  SquareFile file;
  const int accessor = file.add(positions, 5126, "VEC3", 3 * faces);
  file.primitive = fmt::format(R"("attributes": {{"POSITION": {}}}, "material": 0)", accessor);
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
  EXPECT_TRUE(open.warnings.empty());
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
