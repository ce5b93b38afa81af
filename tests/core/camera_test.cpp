#include "core/camera.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/framing.h"
#include "gltf_fixture.h"

namespace photopic {
namespace {

void expect_near(Vec3f a, Vec3f b, float tolerance = 1e-5f) {
  EXPECT_LE(max_abs(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

Camera looking_sideways() {
  Camera c;
  c.position = {1, 2, 3};
  c.right = {0, 0, -1}, c.up = {0, 1, 0}, c.back = {-1, 0, 0};
  c.tan_half_yfov = 0.3f;
  c.width = 40, c.height = 30;
  return c;
}

/// Where a ray meets the plane at a depth from the camera.
Vec3f at_depth(const Camera& camera, const Ray& ray, float depth) {
  const float t = (-depth - dot(ray.origin - camera.position, camera.back)) / dot(ray.direction, camera.back);
  return ray.origin + ray.direction * t;
}

TEST(Camera, OrthographicPixelsAreSquaresOfOneSize) {
  Camera c = looking_sideways();
  c.half_height = 1.5f;  // 3 m over 30 pixels
  const Ray middle = c.ray(20.0f, 15.0f), corner = c.ray(0.0f, 0.0f), next = c.ray(1.0f, 1.0f);
  expect_near(middle.origin, c.position);
  for (const Ray& ray : {middle, corner, next}) EXPECT_EQ(ray.direction, (Vec3f{1, 0, 0}));
  expect_near(corner.origin - middle.origin, c.right * -2.0f + c.up * 1.5f);
  expect_near(next.origin - corner.origin, c.right * 0.1f - c.up * 0.1f, 1e-6f);
}

/// A point at depth d blurs, seen in the plane of depth d itself, to a disk of radius A·|d − f|/f
/// (perspective: similar triangles about the point of focus; orthographic the same), uniformly lit.
TEST(Camera, CircleOfConfusion) {
  for (const float half_height : {0.0f, 1.5f}) {
    Camera c = looking_sideways();
    c.half_height = half_height;
    c.aperture_radius = 0.05f, c.focus_distance = 4.0f;
    for (const float depth : {1.0f, 3.0f, 4.0f, 10.0f}) {
      const float radius = c.aperture_radius * std::abs(depth - c.focus_distance) / c.focus_distance;
      const Vec3f sharp = at_depth(c, c.ray(31.0f, 4.0f), depth);
      EXPECT_NEAR(-dot(sharp - c.position, c.back), depth, 1e-4f);
      double mean_square = 0.0;
      float largest = 0.0f;
      constexpr int kSide = 64;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Sample2d u{(static_cast<float>(i % kSide) + 0.5f) / kSide,
                         (static_cast<float>(i / kSide) + 0.5f) / kSide};
        const float r = length(at_depth(c, c.ray(31, 4, u), depth) - sharp);
        largest = std::max(largest, r);
        mean_square += r * r / (kSide * kSide);
      }
      EXPECT_LE(largest, radius + 1e-5f);
      EXPECT_GE(largest, 0.98f * radius);
      EXPECT_NEAR(mean_square, 0.5 * radius * radius, 2e-3 * radius * radius + 1e-10);
    }
  }
}

TEST(Camera, DiskIsUniform) {
  // Equal cells of the square become cells of equal area: each quadrant and each ring gets its share.
  int quadrants[4] = {}, inner = 0;
  constexpr int kSide = 200;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Sample2d p = sample_disk(
        {(static_cast<float>(i % kSide) + 0.5f) / kSide, (static_cast<float>(i / kSide) + 0.5f) / kSide});
    EXPECT_LE(p.x * p.x + p.y * p.y, 1.00001f);
    ++quadrants[(p.x > 0) + 2 * (p.y > 0)];
    inner += p.x * p.x + p.y * p.y < 0.36f;
  }
  for (const int count : quadrants) EXPECT_EQ(count, kSide * kSide / 4);
  EXPECT_NEAR(inner, 0.36 * kSide * kSide, 1e-9);
  EXPECT_EQ(sample_disk({0.5f, 0.5f}).x, 0.0f);
}

/// Every triangle is in the picture, whatever its shape, and the sphere reaches near its edge.
TEST(Framing, EverythingIsInView) {
  Geometry g;
  g.positions = {{-3, 0, 1}, {4, 0, 1}, {4, 0.5f, -6}, {1000, 0, 0}};  // the last is no triangle's
  g.triangles = {{0, 1, 2}};
  g.shapes = {{0, 1, 0}};
  const BoundingSphere sphere = bounding_sphere(g);
  expect_near(sphere.middle, {0.5f, 0.25f, -2.5f});
  for (const auto& [width, height] : {std::pair{640, 480}, {100, 400}, {800, 80}}) {
    Camera c;
    c.width = width, c.height = height;
    frame(sphere, c);
    EXPECT_GT(dot(c.back, Vec3f{0, 0, 1}), 0.5f);
    EXPECT_GT(c.back.y, 0.0f);
    EXPECT_GT(c.back.x, 0.0f);
    expect_near(cross(c.right, c.up), c.back);
    const float tan_half_x = c.tan_half_yfov * static_cast<float>(width) / static_cast<float>(height);
    for (int i = 0; i < 3; ++i) {
      const Vec3f p = g.positions[static_cast<std::size_t>(i)] - c.position;
      const float depth = -dot(p, c.back);
      EXPECT_LT(std::abs(dot(p, c.up)), c.tan_half_yfov * depth);
      EXPECT_LT(std::abs(dot(p, c.right)), tan_half_x * depth);
    }
    const float edge = std::sin(std::atan(std::min(c.tan_half_yfov, tan_half_x)));
    EXPECT_NEAR(sphere.radius / length(sphere.middle - c.position), edge, 0.06f * edge);
  }
}

using GltfCamera = GltfTest;

SquareFile with_camera(const std::string& camera, const std::string& node = "") {
  SquareFile file;
  file.nodes = R"([{"mesh": 0}, {"camera": 0, "name": "tripod", "translation": [0.5, 0.5, 4])" + node + "}]";
  file.roots = "[0, 1]";
  file.more = fmt::format(R"(, "cameras": [{{{}}}])", camera);
  return file;
}

TEST_F(GltfCamera, OrthographicWhateverTheNodesScale) {
  const Camera c =
      load(with_camera(
               R"("type": "orthographic", "orthographic": {"xmag": 3, "ymag": 1.5, "znear": 0, "zfar": 1})",
               R"(, "scale": [7, 7, 7])")
               .str())
          .camera;
  EXPECT_TRUE(c.orthographic());
  EXPECT_EQ(c.half_height, 1.5f);
  EXPECT_EQ(c.width, 640);
  EXPECT_EQ(c.height, 320);
  EXPECT_NEAR(c.ray(0.0f, 0.0f).origin.x, -3.0f, 1e-5f);
  for (const char* mag : {"0", "1e-300"}) {
    const std::string text = refusal(
        with_camera(
            fmt::format(
                R"("type": "orthographic", "orthographic": {{"xmag": 1, "ymag": {}, "znear": 0, "zfar": 1}})",
                mag))
            .str());
    EXPECT_NE(text.find("#/cameras/0/orthographic/ymag"), std::string::npos) << text;
  }
  EXPECT_NE(refusal(with_camera(R"("type": "orthographic", "orthographic": {"xmag": 1})").str()).find("ymag"),
            std::string::npos);
}

TEST_F(GltfCamera, AspectRatioIsOptional) {
  EXPECT_EQ(load(with_camera(R"("type": "perspective", "perspective": {"yfov": 1})").str()).camera.height,
            480);
}

TEST_F(GltfCamera, NamesAndIndices) {
  SquareFile file = with_camera(
      R"("type": "perspective", "perspective": {"yfov": 1}}, {"type": "orthographic", "name": "0", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 1}}, {"type": "perspective", "perspective": {"yfov": 2})");
  file.nodes.insert(file.nodes.size() - 1, R"(, {"camera": 1}, {"camera": 2})");
  file.roots = "[0, 1, 2, 3]";
  const auto yfov = [&](const char* name) {
    const Camera c = load(file.str(), {.camera = name}).camera;
    return c.orthographic() ? 0.0 : 2.0 * std::atan(c.tan_half_yfov);
  };
  EXPECT_NEAR(yfov(""), 1.0, 1e-6);
  EXPECT_NEAR(yfov("tripod"), 1.0, 1e-6);
  EXPECT_NEAR(yfov("2"), 2.0, 1e-6);
  EXPECT_EQ(yfov("0"), 0.0);  // a name wins over an index
  for (const char* name : {"3", "-1", "2x"}) {
    const std::string text = refusal(file.str(), {.camera = name});
    EXPECT_NE(text.find("choose one of \"tripod\", \"0\", \"index:2\""), std::string::npos) << text;
  }
}

TEST_F(GltfCamera, ThinLensByExtras) {
  const auto with_extras = [](const char* extras) {
    return with_camera(
               fmt::format(R"("type": "perspective", "perspective": {{"yfov": 1}}, "extras": {})", extras),
               R"(, "scale": [3, 3, 3])")
        .str();
  };
  const Camera c = load(with_extras(R"({"aperture_radius": 0.02, "focus_distance": 3})")).camera;
  EXPECT_EQ(c.aperture_radius, 0.02f);  // not scaled by the node
  EXPECT_EQ(c.focus_distance, 3.0f);
  EXPECT_FALSE(load(with_extras(R"({"focus_distance": 3})")).camera.has_lens());
  for (const auto& [extras, key] : {std::pair{R"({"aperture_radius": 0.02})", "aperture_radius"},
                                    {R"({"aperture_radius": 0.02, "focus_distance": 0})", "aperture_radius"},
                                    {R"({"aperture_radius": -1, "focus_distance": 3})", "aperture_radius"},
                                    {R"({"aperture_radius": 1, "focus_distance": "near"})", "focus_distance"},
                                    {R"({"resolution": [640]})", "resolution"}}) {
    const std::string text = refusal(with_extras(extras));
    EXPECT_NE(text.find(fmt::format("#/cameras/0/extras/{}:", key)), std::string::npos) << text;
  }
}

TEST_F(GltfCamera, WithoutOneTheSceneIsFramed) {
  GltfOptions options{.width = 30, .height = 20};
  SquareFile file;
  file.nodes = R"([{"mesh": 0, "translation": [1e6, 0, 0]}])";
  const Scene scene = load_gltf(write("a.gltf", file.str()), options);
  EXPECT_EQ(scene.camera.width, 30);
  EXPECT_NEAR(length(scene.camera.position), 1.05 * std::sqrt(0.5) / std::sin(kPi / 9), 1e-4);
  EXPECT_EQ(std::ranges::count(scene.warnings,
                               "no camera in " + (folder_ / "a.gltf").string() + ": framing the whole scene"),
            1);
  EXPECT_NE(refusal(file.str(), {.camera = "one"}).find("leave the option out"), std::string::npos);
}

}  // namespace
}  // namespace photopic
