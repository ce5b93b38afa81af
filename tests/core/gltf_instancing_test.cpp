#include "core/framing.h"
#include "gltf_fixture.h"

namespace photopic {
namespace {

constexpr int kByte = 5120, kShort = 5122, kFloat = 5126;

using GltfInstancing = GltfTest;

void expect_near(Vec3f a, Vec3f b, float tolerance = 1e-5f) {
  EXPECT_LE(max_abs(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

/// The square again and again: 2·`repeats` triangles on the same four vertices.
SquareFile dense_square(std::size_t repeats) {
  SquareFile file;
  std::vector<std::uint16_t> indices;
  for (std::size_t i = 0; i < repeats; ++i) indices.insert(indices.end(), {0, 1, 2, 0, 2, 3});
  const int accessor = file.add(indices, 5123, "SCALAR", indices.size());
  file.primitive = fmt::format(R"("attributes": {{"POSITION": 0}}, "indices": {}, "material": 0)", accessor);
  return file;
}

void place_in_rows(SquareFile& file, int count) {
  file.nodes = "[", file.roots = "[";
  for (int i = 0; i < count; ++i) {
    file.nodes += fmt::format(R"({}{{"mesh": 0, "translation": [{}, 5, -3]}})", i > 0 ? "," : "", 2 * i);
    file.roots += fmt::format("{}{}", i > 0 ? "," : "", i);
  }
  file.nodes += "]", file.roots += "]";
}

/// 2000 triangles are shared where that saves more than 100,000: from 52 uses on.
TEST_F(GltfInstancing, MeshesAreSharedWhereThatSavesMemory) {
  SquareFile file = dense_square(1000);
  place_in_rows(file, 51);
  Geometry g = load(file.str()).geometry;
  EXPECT_TRUE(g.instances.empty() && g.prototypes.empty());
  EXPECT_EQ(g.triangles.size(), 51u * 2000u);

  place_in_rows(file, 60);
  const Scene scene = load(file.str());
  g = scene.geometry;
  ASSERT_EQ(g.prototypes.size(), 1u);
  ASSERT_EQ(g.instances.size(), 60u);
  EXPECT_EQ(g.triangles.size(), 2000u);
  EXPECT_EQ(g.positions.size(), 4u);
  EXPECT_EQ(g.baked_shape_count(), 0u);
  // From x = 0 to 2·59 + 1.
  expect_near(to_float(scene.origin), {59.5f, 5.5f, -3});
  for (int i = 0; i < 60; ++i) {
    const Vec3f corner = g.instances[static_cast<std::size_t>(i)].to_world.point(g.positions[2]);
    expect_near(to_float(to_double(corner) + scene.origin), {2.0f * static_cast<float>(i) + 1, 6, -3});
  }
  const BoundingSphere sphere = bounding_sphere(g);
  EXPECT_NEAR(sphere.radius, std::hypot(59.5, 0.5), 1e-4);
}

/// Lamps stay triangles of the world, and so does what cannot be turned back.
TEST_F(GltfInstancing, LampsAndFlattenedMeshesAreBaked) {
  SquareFile file = dense_square(1000);
  place_in_rows(file, 60);
  file.materials = R"([{"emissiveFactor": [0, 0, 0.1]}])";
  Geometry g = load(file.str()).geometry;
  EXPECT_TRUE(g.instances.empty());
  EXPECT_EQ(g.triangles.size(), 120'000u);

  file = dense_square(1000);
  place_in_rows(file, 60);
  file.nodes.insert(file.nodes.find("\"mesh\""), R"("scale": [2, 0, 0.5], )");
  g = load(file.str()).geometry;
  EXPECT_EQ(g.instances.size(), 59u);
}

/// The middle of a prototype is taken out: far from its mesh's zero, floats stay exact.
TEST_F(GltfInstancing, MeshesFarFromTheirZero) {
  SquareFile file = dense_square(1000);
  for (std::size_t i = 0; i < 12; i += 3)
    file.positions[i] += 4e6f;  // exact: a quarter is a unit in the last place
  place_in_rows(file, 60);
  const Scene scene = load(file.str());
  const Geometry& g = scene.geometry;
  ASSERT_EQ(g.instances.size(), 60u);
  expect_near(g.positions[0], {-0.5f, -0.5f, 0}, 0.0f);
  EXPECT_NEAR(scene.origin.x, 4e6 + 59.5, 1e-6);
  expect_near(g.instances[0].to_world.point(g.positions[0]), {-59.5f, -0.5f, 0});
}

SquareFile gpu_instances(const std::string& attributes) {
  SquareFile file;
  file.nodes = fmt::format(
      R"([{{"mesh": 0, "translation": [10, 0, 0], "extensions": {{"EXT_mesh_gpu_instancing": {{"attributes": {{{}}}}}}}}}])",
      attributes);
  file.more =
      R"(, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"])";
  return file;
}

std::string attribute(const char* name, int accessor) {
  return fmt::format(R"("{}": {})", name, accessor);
}

Vec3f world_position(const Scene& scene, std::size_t i) {
  return to_float(to_double(scene.geometry.positions.at(i)) + scene.origin);
}

/// Translation × rotation × scale below the node; rotations as floats and as normalised integers.
TEST_F(GltfInstancing, GpuInstances) {
  const auto check = [&](auto one, auto root_half, int type, bool normalized) {
    using T = decltype(one);
    const T zero = 0;
    SquareFile file;
    const int t = file.add(std::vector<float>{0, 0, 0, 1, 2, 3}, kFloat, "VEC3", 2);
    const int r = file.add(std::vector<T>{zero, zero, zero, one, zero, zero, root_half, root_half}, type,
                           "VEC4", 2, normalized);
    const int s = file.add(std::vector<float>{1, 1, 1, 2, 3, 1}, kFloat, "VEC3", 2);
    const SquareFile node = gpu_instances(attribute("TRANSLATION", t) + "," + attribute("ROTATION", r) + "," +
                                          attribute("SCALE", s));
    file.nodes = node.nodes, file.more = node.more;
    const Scene scene = load(file.str());
    ASSERT_EQ(scene.geometry.triangles.size(), 4u);
    EXPECT_TRUE(scene.warnings.empty());
    expect_near(world_position(scene, 2), {11, 1, 0});
    expect_near(world_position(scene, 6), {10 + 1 - 3, 2 + 2, 3});  // (2, 3, 0) after a quarter turn about z
  };
  check(1.0f, 0.70710678f, kFloat, false);
  check(std::int8_t{127}, std::int8_t{90}, kByte, true);
  check(std::int16_t{32767}, std::int16_t{23170}, kShort, true);
}

/// What is not given has its default, whatever gives the number.
TEST_F(GltfInstancing, GpuInstancesByAnAttributeOfTheFilesOwn) {
  SquareFile file;
  const int id = file.add(std::vector<float>{7, 8, 9}, kFloat, "SCALAR", 3);
  const SquareFile node = gpu_instances(attribute("_ID", id));
  file.nodes = node.nodes, file.more = node.more;
  const Scene scene = load(file.str());
  ASSERT_EQ(scene.geometry.triangles.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) expect_near(world_position(scene, 4 * i + 2), {11, 1, 0});
}

TEST_F(GltfInstancing, GpuInstancesAreShared) {
  SquareFile file = dense_square(1000);
  const int t = file.add(std::vector<float>(300, 1.0f), kFloat, "VEC3", 100);
  const SquareFile node = gpu_instances(attribute("TRANSLATION", t));
  file.nodes = node.nodes, file.more = node.more;
  EXPECT_EQ(load(file.str()).geometry.instances.size(), 100u);
}

TEST_F(GltfInstancing, WrongGpuInstancesAreRefused) {
  const auto refused = [&](const auto& attributes_of) {
    SquareFile file;
    const std::string attributes = attributes_of(file);
    const SquareFile node = gpu_instances(attributes);
    file.nodes = node.nodes, file.more = node.more;
    const std::string text = refusal(file.str());
    EXPECT_TRUE(text.find("#/nodes/0/extensions/EXT_mesh_gpu_instancing") != std::string::npos ||
                text.find("#/accessors/2") != std::string::npos)
        << text;
  };
  refused([](SquareFile&) { return std::string(); });
  refused([](SquareFile&) { return attribute("TRANSLATION", 7); });
  refused([](SquareFile& file) {
    return attribute("TRANSLATION", 0) + "," +
           attribute("SCALE", file.add(std::vector<float>(6, 1.0f), kFloat, "VEC3", 2));
  });
  refused([](SquareFile& file) {
    return attribute("ROTATION", file.add(std::vector<float>(8, 0.0f), kFloat, "VEC4", 2));
  });
  refused([](SquareFile& file) {
    return attribute("SCALE", file.add(std::vector<float>(6, INFINITY), kFloat, "VEC3", 2));
  });
  refused([](SquareFile& file) {
    return attribute("TRANSLATION", file.add(std::vector<float>(4, 1.0f), kFloat, "VEC2", 2));
  });
}

}  // namespace
}  // namespace photopic
