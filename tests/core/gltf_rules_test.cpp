#include <nlohmann/json.hpp>

#include "gltf_fixture.h"

namespace photopic {
namespace {

using Json = nlohmann::json;

/// tests/gltf/all_features.gltf, changed in one place.
class GltfRulesTest : public GltfTest {
 protected:
  static Json all_features() { return Json::parse(std::ifstream(PHOTOPIC_GLTF "/all_features.gltf")); }

  static std::string changed(const std::string& pointer, const std::string& value) {
    Json document = all_features();
    document[Json::json_pointer(pointer)] = Json::parse(value);
    return document.dump();
  }
};

TEST_F(GltfRulesTest, AllFeaturesLoad) {
  EXPECT_GT(load(all_features().dump()).geometry.triangles.size(), 8u);
}

/// A member's place, a value it must not have, and the place that the message names if it is another.
struct Spoiled {
  std::string pointer, value;
  std::string named = pointer;
};

TEST_F(GltfRulesTest, EachRuleIsHeld) {
  const std::string material = "/materials/0", extensions = material + "/extensions/";
  const std::string glass = "/materials/1/extensions/", lights = "/extensions/KHR_lights_punctual/lights";
  const std::string transform = "/materials/0/normalTexture/extensions/KHR_texture_transform";
  const std::string primitive = "/meshes/0/primitives/0", attributes = primitive + "/attributes/";
  const std::string copies = "/nodes/6/extensions/EXT_mesh_gpu_instancing/attributes";
  const Spoiled cases[] = {
      {"/images/0/bufferView", "99"},
      {"/images/0/uri", "\"both.png\"", "/images/0"},
      {"/images/1", "{}"},
      {"/textures/0/source", "2"},
      {"/textures/0/sampler", "-1"},
      {"/textures/0/extensions/EXT_texture_webp/source", "2"},
      {"/textures/0/extensions/KHR_texture_basisu/source", "\"0\""},
      {"/samplers/0/wrapS", "10496"},
      {"/samplers/0/magFilter", "9984"},
      {"/samplers/0/minFilter", "true"},
      {material + "/alphaMode", "\"CUTOUT\""},
      {material + "/alphaCutoff", "-0.5"},
      {material + "/normalTexture/index", "7"},
      {material + "/normalTexture/texCoord", "4"},
      {material + "/normalTexture/scale", "\"1\""},
      {material + "/occlusionTexture/strength", "1.5"},
      {material + "/emissiveTexture", "{}"},
      {material + "/extensions", "[]"},
      {transform, "3"},
      {transform + "/offset", "[1]"},
      {transform + "/scale/1", "null"},
      {transform + "/rotation", "[0]"},
      {transform + "/texCoord", "-1"},
      {extensions + "KHR_materials_clearcoat/clearcoatFactor", "2"},
      {extensions + "KHR_materials_clearcoat/clearcoatNormalTexture/index", "2"},
      {extensions + "KHR_materials_sheen/sheenColorFactor/0", "-1"},
      {extensions + "KHR_materials_sheen/sheenRoughnessTexture/index", "null"},
      {extensions + "KHR_materials_anisotropy/anisotropyStrength", "-1"},
      {extensions + "KHR_materials_anisotropy/anisotropyTexture/texCoord", "1.5"},
      {extensions + "KHR_materials_iridescence/iridescenceIor", "0.5"},
      {extensions + "KHR_materials_iridescence/iridescenceThicknessMaximum", "-1"},
      {extensions + "KHR_materials_iridescence/iridescenceThicknessTexture/index", "99"},
      {extensions + "KHR_materials_specular/specularTexture/index", "99"},
      {extensions + "KHR_materials_emissive_strength/emissiveStrength", "-1"},
      {glass + "KHR_materials_diffuse_transmission/diffuseTransmissionFactor", "1.01"},
      {glass + "KHR_materials_diffuse_transmission/diffuseTransmissionTexture/index", "{}"},
      {glass + "KHR_materials_transmission/transmissionTexture/index", "-1"},
      {glass + "KHR_materials_volume/thicknessFactor", "-1"},
      {glass + "KHR_materials_volume/attenuationColor", "[1, 1]"},
      {glass + "KHR_materials_dispersion/dispersion", "-0.1"},
      {glass + "KHR_materials_dispersion", "0.1"},
      {lights, "{}"},
      {lights + "/0/type", "\"area\""},
      {lights + "/0/intensity", "-1"},
      {lights + "/0/color", "[1, -1, 1]", lights + "/0/color/1"},
      {lights + "/1/range", "0"},
      {lights + "/2/spot/outerConeAngle", "1.6"},
      {lights + "/2/spot/innerConeAngle", "0.6", lights + "/2/spot"},
      {lights + "/1/type", "\"spot\"", lights + "/1"},
      {"/nodes/5/extensions/KHR_lights_punctual/light", "3"},
      {"/nodes/5/extensions/KHR_lights_punctual", "{}"},
      {"/nodes/7/extensions/KHR_node_visibility/visible", "0"},
      {copies + "/ROTATION", "99"},
      {copies + "/SCALE", "0"},
      {copies, "null"},
      {"/cameras/1/orthographic/xmag", "0"},
      {"/cameras/1/orthographic/zfar", "0.05"},
      {"/cameras/1/orthographic", "{}"},
      {"/cameras/0/type", "\"fisheye\""},
      {"/cameras/0/type", "\"orthographic\"", "/cameras/0"},
      {"/cameras/0/perspective/aspectRatio", "0"},
      {attributes + "TEXCOORD_0", "0"},
      {attributes + "TANGENT", "1"},
      {attributes + "COLOR_0", "19"},
      {primitive + "/targets/0/POSITION", "99"},
      {primitive + "/targets/0/NORMAL", "3"},
      {"/meshes/1/primitives/1/targets", "[{}]", "/meshes/1/primitives/1"},
      {"/meshes/0/weights", "[1]"},
      {"/nodes/1/weights", "[1, 0, 0]"},
      {"/nodes/8/skin", "1"},
      {"/skins/0/joints/1", "99"},
      {"/skins/0/inverseBindMatrices", "0"},
      {"/skins/0/joints", "[0, 9, 9]", "/skins/0/inverseBindMatrices"},
      {"/animations/0/channels/0/target/node", "99"},
      {"/animations/0/samplers/0/input", "99"},
      {"/accessors/14/sparse/indices/byteOffset", "2147483648"},
      {"/accessors/14/sparse/values/byteOffset", "2147483648"},
      {"/materials/0/name", "7"},
      {"/extensionsRequired", "[\"KHR_draco_mesh_compression\"]", "/extensionsRequired/0"},
  };
  for (const Spoiled& spoiled : cases) {
    SCOPED_TRACE(spoiled.pointer + " = " + spoiled.value);
    const std::string text = refusal(changed(spoiled.pointer, spoiled.value));
    EXPECT_NE(text.find("#" + spoiled.named + ":"), std::string::npos) << text;
  }
}

/// glTF 2.0, section 2.7: "100, 100.0, and 1e2 represent the same value".
TEST_F(GltfRulesTest, WholeNumbersMayHaveAZeroFraction) {
  const Scene plain = load(all_features().dump());
  std::string text = all_features().dump();
  const std::string whole = "\"count\":4", fraction = "\"count\":0.4e1";
  ASSERT_NE(text.find(whole), std::string::npos);
  for (std::size_t at = 0; (at = text.find(whole, at)) != std::string::npos;)
    text.replace(at, whole.size(), fraction);
  EXPECT_EQ(load(text).geometry.positions, plain.geometry.positions);
  EXPECT_NE(refusal(changed("/accessors/0/count", "3.5")).find("#/accessors/0/count:"), std::string::npos);
}

TEST_F(GltfRulesTest, KeysStandOnce) {
  const std::string text = refusal(R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0, "mesh": 1}]})");
  EXPECT_NE(text.find("#/nodes/0: the key \"mesh\" stands twice"), std::string::npos) << text;
  // The same key in another object, or deeper, is another.
  load(R"({"asset": {"version": "2.0", "extras": {"version": 1}}, "nodes": [{"name": "a"}, {"name": "b"}]})");
}

TEST_F(GltfRulesTest, SceneListsTheFilesItNames) {
  SquareFile square;
  write("a b.bin", square.bytes());
  square.uri = "a%20b.bin";
  square.materials = R"([{"name": "plain", "extras": {"reflectance_spectrum": "grey.csv"}}])";
  square.more = R"(, "images": [{"uri": "unused.png"}, {"uri": "data:image/png;base64,AA=="}])";
  write("grey.csv", "400 0.5\n700 0.5\n");
  const std::vector<std::filesystem::path> expected = {folder_ / "a b.bin", folder_ / "unused.png",
                                                       folder_ / "grey.csv"};
  EXPECT_EQ(load(square.str()).files, expected);
}

TEST_F(GltfRulesTest, GlbWithoutJson) {
  const std::string header = "glTF\x02" + std::string(3, '\0') + "\x0c" + std::string(11, '\0');
  EXPECT_NE(message([&] { load_gltf(write("empty.glb", header)); }).find("no JSON"), std::string::npos);
}

}  // namespace
}  // namespace photopic
