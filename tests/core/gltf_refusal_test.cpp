#include <map>
#include <set>

#include "gltf_fixture.h"

namespace photopic {
namespace {

/// Every refusal names the place by its JSON pointer.
struct Fault {
  const char* pointer;
  void (*spoil)(SquareFile& file);
};

const Fault kFaults[] = {
    {"/asset/version", [](SquareFile& f) { f.asset = R"({"version": "1.0"})"; }},
    {"/asset/minVersion", [](SquareFile& f) { f.asset = R"({"version": "2.0", "minVersion": "2.1"})"; }},
    {"/extensionsRequired/0",
     [](SquareFile& f) { f.more = R"(, "extensionsRequired": ["KHR_draco_mesh_compression"])"; }},
    {"/skins", [](SquareFile& f) { f.more = R"(, "skins": {})"; }},
    {"/scenes/0/nodes/0", [](SquareFile& f) { f.roots = "[7]"; }},
    {"/nodes/0/mesh", [](SquareFile& f) { f.nodes = R"([{"mesh": -1}])"; }},
    {"/nodes/0/mesh", [](SquareFile& f) { f.nodes = R"([{"mesh": 4294967296}])"; }},
    {"/nodes/0/mesh", [](SquareFile& f) { f.nodes = R"([{"mesh": "0"}])"; }},
    {"/nodes/0/matrix", [](SquareFile& f) { f.nodes = R"([{"mesh": 0, "matrix": [1, 2, 3]}])"; }},
    {"/nodes/0/rotation", [](SquareFile& f) { f.nodes = R"([{"mesh": 0, "rotation": [0, 0, 0, 0]}])"; }},
    {"/nodes/0", [](SquareFile& f) { f.nodes = R"([{"mesh": 0, "scale": [1e300, 1, 1]}])"; }},
    {"/nodes/0/children", [](SquareFile& f) { f.nodes = R"([{"mesh": 0, "children": [0]}])"; }},
    {"/nodes/2/children",
     [](SquareFile& f) { f.nodes = R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])"; }},
    {"/meshes/0/primitives/0/attributes/POSITION",
     [](SquareFile& f) { f.primitive = R"("attributes": {"POSITION": 9})"; }},
    {"/meshes/0/primitives/0/attributes/NORMAL",
     [](SquareFile& f) { f.primitive = R"("attributes": {"POSITION": 0, "NORMAL": 9})"; }},
    {"/meshes/0/primitives/0/mode", [](SquareFile& f) { f.primitive += R"(, "mode": 7)"; }},
    {"/meshes/0/primitives/0/material", [](SquareFile& f) { f.primitive += R"(, "material": 1)"; }},
    {"/meshes/0/primitives/0/indices", [](SquareFile& f) { f.indices[4] = 4; }},
    {"/meshes/0/primitives/0", [](SquareFile& f) { f.primitive = ""; }},
    {"/accessors/0", [](SquareFile& f) { f.primitive = R"("attributes": {"POSITION": 0}, "indices": 0)"; }},
    {"/meshes/0/primitives/0/attributes/POSITION",
     [](SquareFile& f) { f.primitive = R"("attributes": {"POSITION": 1})"; }},
    {"/accessors/0", [](SquareFile& f) { f.positions[5] = std::numeric_limits<float>::quiet_NaN(); }},
    {"/accessors/0", [](SquareFile& f) { f.positions[11] = std::numeric_limits<float>::infinity(); }},
    {"/accessors/0/count", [](SquareFile& f) { f.accessors.replace(f.accessors.find("4,"), 1, "0"); }},
    {"/accessors/0/count", [](SquareFile& f) { f.accessors.replace(f.accessors.find("4,"), 1, "-4"); }},
    {"/accessors/0", [](SquareFile& f) { f.accessors.replace(f.accessors.find("4,"), 1, "5"); }},
    {"/accessors/0", [](SquareFile& f) { f.accessors.replace(f.accessors.find("4,"), 1, "2147483647"); }},
    {"/accessors/0/count",
     [](SquareFile& f) {
       f.accessors.replace(0, f.accessors.find("}"),
                           R"({"componentType": 5126, "count": 2000000000, "type": "VEC3")");
     }},
    {"/accessors/0/componentType",
     [](SquareFile& f) { f.accessors.replace(f.accessors.find("5126"), 4, "5124"); }},
    {"/accessors/0/type", [](SquareFile& f) { f.accessors.replace(f.accessors.find("VEC3"), 4, "VEC9"); }},
    {"/bufferViews/0", [](SquareFile& f) { f.views.replace(f.views.find("48"), 2, "99"); }},
    {"/bufferViews/1/byteOffset",
     [](SquareFile& f) { f.views.replace(f.views.find(": 48,"), 4, ": 18446744073709551600"); }},
    {"/bufferViews/0/byteStride", [](SquareFile& f) { f.views.replace(1, 0, R"("byteStride": 256, )"); }},
    {"/accessors/0", [](SquareFile& f) { f.views.replace(1, 0, R"("byteStride": 8, )"); }},
    {"/bufferViews/0/buffer", [](SquareFile& f) { f.views.replace(f.views.find("0"), 1, "1"); }},
    {"/buffers/0/uri", [](SquareFile& f) { f.uri = "missing.bin"; }},
    {"/buffers/0/uri", [](SquareFile& f) { f.uri = "data:application/octet-stream;base64,AAAA"; }},
    {"/buffers/0/uri", [](SquareFile& f) { f.uri = "data:application/octet-stream;base64,*"; }},
    {"/buffers/0/uri", [](SquareFile& f) { f.uri = "."; }},
    {"/materials/0/emissiveFactor/1",
     [](SquareFile& f) { f.materials = R"([{"emissiveFactor": [1, -1, 0]}])"; }},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/index",
     [](SquareFile& f) {
       f.materials = R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])";
     }},
    {"/materials/0/extensions/KHR_materials_ior/ior",
     [](SquareFile& f) { f.materials = R"([{"extensions": {"KHR_materials_ior": {"ior": 0.2}}}])"; }},
    {"/materials/0/extensions/KHR_materials_volume/attenuationDistance",
     [](SquareFile& f) {
       f.materials = R"([{"extensions": {"KHR_materials_volume": {"attenuationDistance": 0}}}])";
     }},
    {"/materials/0/extras/reflectance_spectrum",
     [](SquareFile& f) {
       f.materials = R"([{"extras": {"reflectance_spectrum": {"nm": [400, 700], "value": [20, 80]}}}])";
     }},
    {"/materials/0/extras/reflectance_spectrum",
     [](SquareFile& f) {
       f.materials = R"([{"extras": {"reflectance_spectrum": {"nm": [700, 400], "value": [0, 1]}}}])";
     }},
    {"/materials/0/extras/reflectance_spectrum",
     [](SquareFile& f) { f.materials = R"([{"extras": {"reflectance_spectrum": "no-such-file.csv"}}])"; }},
    {"/materials/0/extras/reflectance_spectrum",
     [](SquareFile& f) { f.materials = R"([{"extras": {"reflectance_spectrum": 7}}])"; }},
    {"/materials/0/extras/emission_spectrum",  // tinygltf drops these and what follows
     [](SquareFile& f) { f.materials = R"([{"extras": {"emission_spectrum": {"nm": [], "value": []}}}])"; }},
    {"/materials/0/extras/emission_spectrum",
     [](SquareFile& f) {
       f.materials =
           R"([{"extras": {"emission_spectrum": {"nm": [400, null, 700], "value": [1, null, 2]}}}])";
     }},
    {"/materials/0/extras/reflectance_spectrum",
     [](SquareFile& f) {
       f.materials =
           R"([{"extras": {"reflectance_spectrum": {"nm": [400, 700], "value": [0, 1], "scale": 0.5}}}])";
     }},
    {"/materials/0/extras/reflectance_spectrum/nm",
     [](SquareFile& f) {
       f.materials = R"([{"extras": {"reflectance_spectrum": {"nm": [0.4, 0.7], "value": [0, 1]}}}])";
     }},
    {"/materials/0/extras/glass",
     [](SquareFile& f) { f.materials = R"([{"extras": {"conductor": "Au", "glass": "BK7"}}])"; }},
    {"/materials/0/extras/conductor",
     [](SquareFile& f) {
       f.materials =
           R"([{"extras": {"conductor": "Au"}, "pbrMetallicRoughness": {"metallicFactor": 0},
           "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.5}}}])";
     }},
    {"/materials/0/extras/reflectance_spectrum",
     [](SquareFile& f) {
       f.materials = R"([{"extras": {"conductor": "Au", "reflectance_spectrum": "constant"}}])";
     }},
    {"/nodes/0/matrix",
     [](SquareFile& f) {
       f.nodes = R"([{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1e-4, 0, 0, 0, 1]}])";
     }},
    {"/nodes/0/matrix",
     [](SquareFile& f) {
       f.nodes = R"([{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.999]}])";
     }},
    {"/scenes/0/nodes/1", [](SquareFile& f) { f.roots = "[0, 0]"; }},
    {"/nodes/0/children/1", [](SquareFile& f) { f.nodes = R"([{"children": [1, 1]}, {"mesh": 0}])"; }},
    {"/extensions/KHR_lights_punctual/lights/0/extras/emission_spectrum",
     [](SquareFile& f) {
       f.more =
           R"(, "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "extras": {"emission_spectrum": 7}}]}})";
     }},
    {"/cameras/0/perspective/yfov",
     [](SquareFile& f) { f.more = R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 0}}])"; }},
    {"/cameras/0/extras/resolution",
     [](SquareFile& f) {
       f.more =
           R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 1}, "extras": {"resolution": [0, 5]}}])";
       f.nodes = R"([{"camera": 0}])";
     }},
};

TEST_F(GltfTest, FaultsAreRefusedByTheirPlace) {
  for (const Fault& fault : kFaults) {
    SquareFile file;
    fault.spoil(file);
    const std::string text = refusal(file.str());
    EXPECT_NE(text.find(std::string("#") + fault.pointer + ":"), std::string::npos)
        << "expected " << fault.pointer << ", got: " << text;
  }
}

TEST_F(GltfTest, SpectraWrittenOutHaveTheUnitOfFiles) {
  SquareFile file;
  file.materials =
      R"([{"emissiveFactor": [1, 1, 1], "extras": {"emission_spectrum": {"nm": [0.38, 0.78], "value": [1, 1]}}}])";
  const std::string text = refusal(file.str());
  EXPECT_NE(text.find("the wavelengths, 0.38 to 0.78, look like micrometres"), std::string::npos) << text;
  EXPECT_NE(text.find("give them in nm"), std::string::npos) << text;
}

TEST_F(GltfTest, WhatIsNoGltfIsRefused) {
  for (const char* text : {"", " ", "[]", "7", "{", "{\"asset\": 3}", "{\"asset\": {}}",
                           "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": 3}",
                           "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": [1]}", "glTF", "\xff\xfe"}) {
    EXPECT_FALSE(refusal(text).empty()) << text;
  }
  EXPECT_FALSE(message([&] { load_gltf(folder_); }).empty());
  EXPECT_FALSE(message([&] { load_gltf(folder_ / "none.gltf"); }).empty());
}

TEST_F(GltfTest, DeepNestingIsRefusedBeforeParsing) {
  const std::string text = refusal(R"({"asset": {"version": "2.0", "extras": )" + std::string(200'000, '[') +
                                   std::string(200'000, ']') + "}}");
  EXPECT_NE(text.find("#/asset/extras/0/0"), std::string::npos) << text;
  EXPECT_NE(text.find("nested"), std::string::npos) << text;
}

/// 40 levels of two nodes, each the parent of both on the next: 2^40 instances.
TEST_F(GltfTest, GraphsThatMultiplyAreRefused) {
  SquareFile file;
  file.nodes = "[";
  for (int i = 0; i < 80; ++i)
    file.nodes += fmt::format(R"({{"children": [{}, {}]}}, )", i / 2 * 2 + 2, i / 2 * 2 + 3);
  file.nodes += R"({"mesh": 0}, {"mesh": 0}])";
  EXPECT_NE(refusal(file.str()).find("multiply"), std::string::npos);
}

TEST_F(GltfTest, OddButValidFilesLoadWithAWarning) {
  SquareFile flat;
  flat.nodes = R"([{"mesh": 0, "scale": [1, 1, 0]}])";
  EXPECT_EQ(load(flat.str()).geometry.triangles.size(), 2u);
  EXPECT_EQ(load(flat.str()).warnings.size(), 1u);

  SquareFile rounded;
  rounded.nodes =
      R"([{"mesh": 0, "matrix": [1, 0, 0, 1e-9, 0, 1, 0, 0, 0, 0, 1, -1e-9, 0, 0, 0, 1.0000001]}])";
  EXPECT_EQ(area_vector(load(rounded.str()), 0), (Vec3f{0, 0, 1}));
  EXPECT_TRUE(load(rounded.str()).warnings.empty());

  SquareFile degenerate;
  degenerate.indices = {0, 1, 2, 3, 3, 1};
  EXPECT_EQ(load(degenerate.str()).geometry.triangles.size(), 1u);
  EXPECT_EQ(load(degenerate.str()).warnings.size(), 1u);

  SquareFile points;
  points.primitive += R"(, "mode": 0)";
  EXPECT_TRUE(load(points.str()).geometry.triangles.empty());
  const std::vector<std::string> warnings = load(points.str()).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[1].find("no triangles in "), std::string::npos) << warnings[1];

  std::string text = SquareFile().str();
  text.replace(text.find(R"("meshes": [)"), 11, R"("meshes": [{"primitives": []}, )");
  text.replace(text.find(R"({"mesh": 0})"), 11, R"({"mesh": 0}, {"mesh": 1})");
  text.replace(text.find(R"("nodes": [0])"), 12, R"("nodes": [0, 1])");
  EXPECT_EQ(load(text).geometry.triangles.size(), 2u);
  EXPECT_EQ(load(text).warnings, std::vector<std::string>{"meshes without primitives: 1"});

  SquareFile optional;
  optional.more = R"(, "extensionsUsed": ["XX_unheard_of", "XX_unheard_of", "KHR_materials_variants"])";
  EXPECT_EQ(load(optional.str()).warnings.size(), 1u);

  // Whether they are declared, and how often they are there, is all the same.
  optional.materials = R"([{"extensions": {"XX_unheard_of": {}, "KHR_materials_ior": {}, "XX_undeclared": {}},
      "extras": {"extensions": {"XX_of_others": {}}}}, {"extensions": {"XX_undeclared": {"deep": 1}}}])";
  EXPECT_EQ(load(optional.str()).warnings,
            (std::vector<std::string>{"the extension XX_undeclared is ignored",
                                      "the extension XX_unheard_of is ignored"}));
}

TEST_F(GltfTest, CompressedGeometryIsRefusedUnlessItIsThereUncompressedToo) {
  SquareFile draco;
  draco.primitive +=
      R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}})";
  EXPECT_EQ(load(draco.str()).geometry.triangles.size(), 2u);
  draco.accessors.replace(draco.accessors.find(R"("bufferView": 1,)"), 16, "");
  const std::string refused = refusal(draco.str());
  EXPECT_NE(refused.find("#/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: "),
            std::string::npos)
      << refused;
  EXPECT_NE(refused.find("Draco"), std::string::npos) << refused;
  EXPECT_NE(refused.find("export it without compression"), std::string::npos) << refused;

  SquareFile meshopt;
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    meshopt.views = fmt::format(
        R"({{"buffer": 0, "byteLength": 48, "extensions": {{"{}": {{"buffer": 0, "count": 4}}}}}}, )"
        R"({{"buffer": 0, "byteOffset": 48, "byteLength": 12}})",
        name);
    EXPECT_EQ(load(meshopt.str()).geometry.triangles.size(), 2u);
    std::string text = meshopt.str();
    text.replace(text.find(R"(, "uri": )"),
                 meshopt.buffer().size() - meshopt.buffer().find(", \"uri\": ") - 1, "");
    const std::string without_fallback = refusal(text);
    EXPECT_NE(without_fallback.find(fmt::format("#/bufferViews/0: it is compressed by {}", name)),
              std::string::npos)
        << without_fallback;
  }
}

/// What the specification forbids though all readers agree on what it means.
TEST_F(GltfTest, ForbiddenButClearFilesLoadWithAWarning) {
  const auto only_warning = [](const Scene& scene) {
    EXPECT_EQ(scene.warnings.size(), 1u);
    return scene.warnings.empty() ? std::string() : scene.warnings.front();
  };
  SquareFile twice;
  twice.nodes =
      R"([{"mesh": 0, "matrix": [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1], "scale": [3, 3, 3]}])";
  const Scene stretched = load(twice.str());
  EXPECT_NE(only_warning(stretched).find("the matrix counts: 1"), std::string::npos);
  EXPECT_EQ(area_vector(stretched, 0), (Vec3f{0, 0, 2}));

  SquareFile bright;
  const int color = bright.add<float>({2, 0, 0, 1, 1, 1, 0.5f, 0.5f, 0.5f, 0, 0, 0}, 5126, "VEC3", 4);
  bright.primitive.insert(bright.primitive.find("POSITION") - 1, fmt::format(R"("COLOR_0": {}, )", color));
  const Scene clamped = load(bright.str());
  EXPECT_NE(only_warning(clamped).find("COLOR_0"), std::string::npos);
  EXPECT_EQ(clamped.geometry.colors.at(0).x, 1.0f);

  SquareFile shorts;
  const int corners =
      shorts.add<std::int16_t>({0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0}, 5122, "VEC3", 4);
  shorts.views.insert(shorts.views.rfind('}'), R"(, "byteStride": 8)");
  shorts.primitive = fmt::format(R"("attributes": {{"POSITION": {}}}, "indices": 1)", corners);
  const Scene square = load(shorts.str());
  EXPECT_NE(only_warning(square).find("KHR_mesh_quantization"), std::string::npos);
  EXPECT_EQ(area_vector(square, 0), (Vec3f{0, 0, 1}));
  shorts.more =
      R"(, "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"])";
  EXPECT_TRUE(load(shorts.str()).warnings.empty());
}

class SharedFiles : public GltfTest {
 protected:
  void SetUp() override {
    GltfTest::SetUp();
    if (!std::filesystem::is_directory(shared_)) GTEST_SKIP() << "no collection of glTF files in " << shared_;
  }
  const std::filesystem::path shared_ = std::filesystem::path(PHOTOPIC_SHARED) / "gltf";
};

TEST_F(SharedFiles, GoodFilesLoad) {
  const std::map<std::string, std::size_t> triangles = {
      {"BoxInterleaved.glb", 12},        {"TriangleWithoutIndices.gltf", 1},
      {"MultipleScenes.gltf", 2},        {"SimpleSparseAccessor.gltf", 12},
      {"Mesh_PrimitiveMode_04.gltf", 2}, {"Mesh_PrimitiveMode_05.gltf", 2},
      {"Mesh_PrimitiveMode_11.gltf", 2}, {"Mesh_PrimitiveMode_12.gltf", 2}};
  std::size_t found = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_ / "good")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
    SCOPED_TRACE(name);
    const Scene scene = load_gltf(entry.path());
    EXPECT_GT(scene.geometry.triangles.size(), 0u);
    if (triangles.contains(name)) {
      EXPECT_EQ(scene.geometry.triangles.size(), triangles.at(name));
      ++found;
    }
  }
  EXPECT_EQ(found, triangles.size());
}

TEST_F(SharedFiles, BadFilesAreRefused) {
  const std::set<std::string> odd = {"geo_degenerate_all", "node_scale_zero", "node_chain_50000"};
  std::size_t warned = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared_ / "bad")) {
    SCOPED_TRACE(entry.path().filename());
    if (odd.contains(entry.path().stem().string())) {
      EXPECT_FALSE(load_gltf(entry.path()).warnings.empty());
      ++warned;
    } else {
      EXPECT_FALSE(message([&] { load_gltf(entry.path()); }).empty());
      ++refused;
    }
  }
  EXPECT_EQ(warned, odd.size());
  EXPECT_GT(refused, 0u);
}

}  // namespace
}  // namespace photopic
