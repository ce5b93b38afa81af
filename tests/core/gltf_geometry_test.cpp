#include "core/gltf/geometry.h"
#include "core/gltf/nodes.h"
#include "gltf_fixture.h"

namespace photopic {
namespace {

constexpr int kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kUInt = 5125, kFloat = 5126;

using GltfGeometry = GltfTest;

void expect_near(Vec3f a, Vec3f b, float tolerance = 1e-5f) {
  EXPECT_LE(max_abs(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

Vec3f world_position(const Scene& scene, std::size_t i) {
  return to_float(to_double(scene.geometry.positions.at(i)) + scene.origin);
}

/// The geometry alone, for materials as told.
Scene load_geometry(const std::filesystem::path& file, const Material& material) {
  const GltfDocument document = read_gltf_document(read_gltf_bytes(file), file);
  Scene scene;
  scene.materials.assign(document.model.materials.size() + 1, material);
  load_gltf_geometry(document, walk_nodes(document, 0, scene.warnings), scene);
  return scene;
}

Material textured(int uv_sets, bool tangents = false) {
  Material m;
  m.uv_sets = static_cast<std::uint8_t>(uv_sets);
  m.needs_tangents = tangents;
  return m;
}

std::string with_attribute(const char* name, int accessor) {
  return fmt::format(R"("attributes": {{"POSITION": 0, "{}": {}}}, "indices": 1)", name, accessor);
}

/// The corner (1, 0.5) in every component type that the specification and KHR_mesh_quantization allow.
TEST_F(GltfGeometry, TextureCoordinatesInAllTypes) {
  const auto corner = [&](auto one, auto half, int type, bool normalized) {
    using T = decltype(one);
    SquareFile file;
    const T zero = 0;
    file.primitive = with_attribute(
        "TEXCOORD_1",
        file.add(std::vector<T>{zero, zero, one, half, one, one, zero, one}, type, "VEC2", 4, normalized));
    const Scene scene = load_geometry(write("a.gltf", file.str()), textured(2));
    EXPECT_TRUE(scene.geometry.uvs[0].empty());
    EXPECT_TRUE(scene.geometry.uvs[2].empty());
    EXPECT_EQ(scene.geometry.uvs[1].size(), 4u);
    EXPECT_EQ(scene.geometry.uvs[1].at(0), Vec2f{});
    return scene.geometry.uvs[1].at(1);
  };
  EXPECT_EQ(corner(1.0f, 0.5f, kFloat, false), (Vec2f{1, 0.5f}));
  EXPECT_EQ(corner(std::uint8_t{255}, std::uint8_t{51}, kUByte, true), (Vec2f{1, 0.2f}));
  EXPECT_EQ(corner(std::uint16_t{65535}, std::uint16_t{13107}, kUShort, true), (Vec2f{1, 0.2f}));
  EXPECT_EQ(corner(std::int8_t{127}, std::int8_t{-128}, kByte, true), (Vec2f{1, -1}));
  EXPECT_EQ(corner(std::int16_t{32767}, std::int16_t{-32768}, kShort, true), (Vec2f{1, -1}));
  EXPECT_EQ(corner(std::uint8_t{200}, std::uint8_t{3}, kUByte, false), (Vec2f{200, 3}));
  EXPECT_EQ(corner(std::int16_t{-300}, std::int16_t{3}, kShort, false), (Vec2f{-300, 3}));
}

TEST_F(GltfGeometry, NothingIsStoredThatNoMaterialNeeds) {
  SquareFile file;
  const int uv = file.add(std::vector<float>(8, 0.5f), kFloat, "VEC2", 4);
  const int tangent = file.add(std::vector<float>(16, 1.0f), kFloat, "VEC4", 4);
  file.primitive = fmt::format(
      R"("attributes": {{"POSITION": 0, "TEXCOORD_0": {}, "TANGENT": {}}}, "indices": 1)", uv, tangent);
  const Geometry g = load_geometry(write("a.gltf", file.str()), textured(0)).geometry;
  EXPECT_TRUE(g.uvs[0].empty() && g.tangents.empty() && g.colors.empty() && g.normals.empty());
  EXPECT_TRUE(g.prototypes.empty() && g.instances.empty());
}

/// Of two primitives one has coordinates and colours: the other's are 0 and white, and one warning says so.
TEST_F(GltfGeometry, PrimitivesWithoutAttributesAreFilled) {
  SquareFile file;
  const int uv = file.add(std::vector<float>(8, 0.5f), kFloat, "VEC2", 4);
  const int color =
      file.add(std::vector<float>{0, 0.5f, 1, 2, -1, 0.5f, 1, 1, 1, 0, 0, 0}, kFloat, "VEC3", 4);
  file.primitive = fmt::format(
      R"("attributes": {{"POSITION": 0}}, "indices": 1}}, {{"attributes": {{"POSITION": 0, "TEXCOORD_0": {}, "COLOR_0": {}}}, "indices": 1)",
      uv, color);
  const Scene scene = load_geometry(write("a.gltf", file.str()), textured(1));
  const Geometry& g = scene.geometry;
  EXPECT_EQ(g.uvs[0],
            (std::vector<Vec2f>{{}, {}, {}, {}, {0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}}));
  ASSERT_EQ(g.colors.size(), 8u);
  EXPECT_EQ(g.colors[0], (Vec4f{1, 1, 1, 1}));
  EXPECT_EQ(g.colors[4], (Vec4f{0, 0.5f, 1, 1}));
  EXPECT_EQ(g.colors[5], (Vec4f{1, 0, 0.5f, 1}));  // limited to [0, 1]
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_NE(scene.warnings[0].find("texture coordinates"), std::string::npos);
  EXPECT_NE(scene.warnings[1].find("COLOR_0"), std::string::npos);
  EXPECT_EQ(g.shapes.size(), 1u);  // the same material
}

TEST_F(GltfGeometry, CoordinatesThatNoPrimitiveHasAreZero) {
  const Scene scene = load_geometry(write("a.gltf", SquareFile{}.str()), textured(5));
  EXPECT_EQ(scene.geometry.uvs[0], std::vector<Vec2f>(4));
  EXPECT_TRUE(scene.geometry.uvs[1].empty());
  EXPECT_EQ(scene.geometry.uvs[2], std::vector<Vec2f>(4));
  ASSERT_EQ(scene.warnings.size(), 1u);
}

TEST_F(GltfGeometry, ColoursOfIntegersAreNormalised) {
  SquareFile file;
  file.primitive = with_attribute(
      "COLOR_0",
      file.add(std::vector<std::uint8_t>{255, 51, 0, 102, 255, 255, 255, 255, 0, 0, 0, 0, 0, 0, 0, 255},
               kUByte, "VEC4", 4, true));
  EXPECT_EQ(load(file.str()).geometry.colors.at(0), (Vec4f{1, 0.2f, 0, 0.4f}));
  SquareFile wide;
  wide.primitive =
      with_attribute("COLOR_0", wide.add(std::vector<std::uint16_t>(16, 13107), kUShort, "VEC4", 4, true));
  EXPECT_EQ(load(wide.str()).geometry.colors.at(3), (Vec4f{0.2f, 0.2f, 0.2f, 0.2f}));
  SquareFile raw;
  raw.primitive = with_attribute("COLOR_0", raw.add(std::vector<std::uint8_t>(16, 255), kUByte, "VEC4", 4));
  EXPECT_NE(refusal(raw.str()).find("normalised"), std::string::npos);
}

TEST_F(GltfGeometry, AttributesHaveOneElementAVertex) {
  for (const char* name : {"NORMAL", "COLOR_0"}) {
    SquareFile file;
    file.primitive = with_attribute(name, file.add(std::vector<float>(9, 0.5f), kFloat, "VEC3", 3));
    EXPECT_NE(refusal(file.str()).find(fmt::format("/attributes/{}", name)), std::string::npos);
  }
  SquareFile file;
  file.primitive = with_attribute("NORMAL", file.add(std::vector<float>(8, 0.5f), kFloat, "VEC2", 4));
  EXPECT_NE(refusal(file.str()).find("VEC3"), std::string::npos);
}

/// The bitangent w·(normal × tangent) goes where the transformation takes it, mirrored or not.
TEST_F(GltfGeometry, TangentFramesFollowTheirTransformation) {
  for (const char* scale : {"[1, 1, 1]", "[-1, 1, 1]", "[1, -2, 1]", "[1, 1, -3]", "[-1, -1, -1]"}) {
    for (const float w : {1.0f, -1.0f}) {
      SquareFile file;
      file.nodes = fmt::format(R"([{{"mesh": 0, "scale": {}, "rotation": [0.3, -0.2, 0.5, 0.7]}}])", scale);
      std::vector<float> normals, tangents;
      for (int i = 0; i < 4; ++i)
        normals.insert(normals.end(), {0, 0, 1}), tangents.insert(tangents.end(), {1, 0, 0, w});
      const int n = file.add(normals, kFloat, "VEC3", 4), t = file.add(tangents, kFloat, "VEC4", 4);
      file.primitive =
          fmt::format(R"("attributes": {{"POSITION": 0, "NORMAL": {}, "TANGENT": {}}}, "indices": 1)", n, t);
      const Scene scene = load_geometry(write("a.gltf", file.str()), textured(0, true));
      const Geometry& g = scene.geometry;
      // The square's corners show where its x and y axes went.
      const Vec3f x = normalize(g.positions[1] - g.positions[0]),
                  y = normalize(g.positions[3] - g.positions[0]);
      const Vec4f& tangent = g.tangents.at(0);
      const Vec3f image{tangent.x, tangent.y, tangent.z};
      expect_near(image, x);
      expect_near(cross(g.normals[0], image) * tangent.w, y * w);
      EXPECT_GT(dot(area_vector(scene, 0), g.normals[0]), 0.0f);
    }
  }
}

/// Two triangles, each a primitive, take three vertices each of a list of four.
TEST_F(GltfGeometry, OfSharedVertexListsEachPrimitiveKeepsItsOwn) {
  SquareFile file;
  const int first = file.add(std::vector<std::uint8_t>{0, 1, 3}, kUByte, "SCALAR", 3);
  const int second = file.add(std::vector<std::uint32_t>{3, 1, 2}, kUInt, "SCALAR", 3);
  const int color =
      file.add(std::vector<float>{0, 0, 0, 0.1f, 0, 0, 0.2f, 0, 0, 0.3f, 0, 0}, kFloat, "VEC3", 4);
  file.primitive = fmt::format(
      R"("attributes": {{"POSITION": 0, "COLOR_0": {2}}}, "indices": {0}}}, {{"attributes": {{"POSITION": 0, "COLOR_0": {2}}}, "indices": {1})",
      first, second, color);
  const Scene scene = load(file.str());
  const Geometry& g = scene.geometry;
  EXPECT_EQ(g.positions.size(), 6u);
  ASSERT_EQ(g.triangles.size(), 2u);
  expect_near(area_vector(scene, 0), {0, 0, 1});
  expect_near(area_vector(scene, 1), {0, 0, 1});
  expect_near(world_position(scene, g.triangles[1][0]), {0, 1, 0});
  EXPECT_EQ(g.colors.at(g.triangles[1][0]).x, 0.3f);
  EXPECT_EQ(g.colors.at(g.triangles[1][2]).x, 0.2f);
}

TEST_F(GltfGeometry, InvisibleNodesAndTheirChildrenAreSkipped) {
  SquareFile file;
  file.nodes =
      R"([{"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": true}}},
          {"children": [2, 3], "extensions": {"KHR_node_visibility": {"visible": false}}},
          {"mesh": 0, "translation": [9, 9, 9], "extensions": {"KHR_node_visibility": {"visible": true}}},
          {"camera": 0, "translation": [0, 0, 7]}])";
  file.roots = "[0, 1]";
  file.more =
      R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 1}}], "extensionsUsed": ["KHR_node_visibility"], "extensionsRequired": ["KHR_node_visibility"])";
  const Scene scene = load(file.str());
  EXPECT_EQ(scene.geometry.triangles.size(), 2u);
  EXPECT_EQ(scene.camera.position.z, 7.0f);  // a camera is no picture of itself
  EXPECT_TRUE(scene.warnings.empty());
}

std::string morph_target(int displacement, const char* weights) {
  return fmt::format(
      R"("attributes": {{"POSITION": 0}}, "indices": 1, "targets": [{{"POSITION": {0}}}, {{"POSITION": {0}}}]}}], {1} "extras": [{{)",
      displacement, weights);
}

/// The displacement (0, 0, 1) of two targets by the mesh's default weights, or the node's own.
TEST_F(GltfGeometry, MorphTargetsStandAtTheirDefaultWeights) {
  SquareFile file;
  const int by = file.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3", 4);
  file.primitive = morph_target(by, R"("weights": [0.25, 0.5],)");
  file.nodes = R"([{"mesh": 0}, {"mesh": 0, "weights": [2, 0]}])";
  file.roots = "[0, 1]";
  const Scene scene = load(file.str());
  expect_near(world_position(scene, 2), {1, 1, 0.75f});
  expect_near(world_position(scene, 6), {1, 1, 2});
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("morph"), std::string::npos);
  file.primitive = morph_target(by, "");
  file.nodes = R"([{"mesh": 0}])", file.roots = "[0]";
  EXPECT_TRUE(load(file.str()).warnings.empty());  // all weights are 0
  expect_near(world_position(load(file.str()), 2), {1, 1, 0});
}

/// Two joints, one moved and one turned: each half of the square goes with its own, a corner with both.
TEST_F(GltfGeometry, SkinsStandInTheirRestPose) {
  SquareFile file;
  const int joints =
      file.add(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, kUByte, "VEC4", 4);
  const int weights =
      file.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 2, 0, 0, 0}, kFloat, "VEC4", 4);
  std::vector<float> bind(32, 0.0f);
  for (const int i : {0, 5, 10, 15, 16, 21, 26, 31}) bind[static_cast<std::size_t>(i)] = 1;
  bind[28] = -1;  // the second joint was bound at x = 1
  const int inverse = file.add(bind, kFloat, "MAT4", 2);
  file.primitive = fmt::format(
      R"("attributes": {{"POSITION": 0, "JOINTS_0": {}, "WEIGHTS_0": {}}}, "indices": 1)", joints, weights);
  file.nodes =
      R"([{"mesh": 0, "skin": 0, "translation": [100, 100, 100]}, {"translation": [0, 0, 3], "children": [2]},
          {"translation": [1, 0, 2]}])";
  file.roots = "[0, 1]";
  file.more = fmt::format(R"(, "skins": [{{"joints": [1, 2], "inverseBindMatrices": {}}}])", inverse);
  const Scene scene = load(file.str());
  expect_near(world_position(scene, 0), {0, 0, 3});
  expect_near(world_position(scene, 1), {1, 0, 5});
  expect_near(world_position(scene, 2), {1, 1, 4});
  expect_near(world_position(scene, 3), {0, 1, 3});  // weights that sum to 2
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("rest pose"), std::string::npos);

  // Without matrices the joints were bound where the mesh has its origin (glTF 2.0, section 3.7.3.1).
  file.more = R"(, "skins": [{"joints": [1, 2]}])";
  expect_near(world_position(load(file.str()), 1), {2, 0, 5});

  file.more = fmt::format(R"(, "skins": [{{"joints": [1], "inverseBindMatrices": {}}}])", inverse);
  EXPECT_NE(refusal(file.str()).find("/attributes/JOINTS_0"), std::string::npos);
  file.more = fmt::format(R"(, "skins": [{{"joints": [1, 2, 1], "inverseBindMatrices": {}}}])", inverse);
  EXPECT_NE(refusal(file.str()).find("/skins/0/inverseBindMatrices"), std::string::npos);
}

}  // namespace
}  // namespace photopic
