#include "support/scene_builder.h"

#include <map>
#include <numbers>

#include "spectral/observer.h"

namespace photopic::test {

std::uint32_t SceneBuilder::material(const Material& m) {
  scene_.materials.push_back(m);
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

std::uint32_t SceneBuilder::lamp(const Spectrum& spectrum, double luminance, bool double_sided) {
  Material m = diffuse(ConstantSpectrum{0.0});
  m.emission_spectrum = emission(spectrum);
  m.emission_luminance = static_cast<float>(luminance);
  m.double_sided = double_sided;
  return material(m);
}

int SceneBuilder::emission(const Spectrum& spectrum) {
  const TabulatedSpectrum table = tabulate_emission(spectrum);
  scene_.emission_spectra.push_back(table.scaled(1.0 / emission_xyz(table, Observer::cie1931()).y));
  scene_.emission_names.push_back("lamp");
  return static_cast<int>(scene_.emission_spectra.size() - 1);
}

std::uint32_t SceneBuilder::vertex(Vec3d p, Vec3d normal) {
  positions_.push_back(p);
  scene_.geometry.normals.push_back(to_float(normal));
  return static_cast<std::uint32_t>(positions_.size() - 1);
}

void SceneBuilder::begin_shape(std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(scene_.geometry.triangles.size());
  scene_.geometry.shapes.push_back({first, 0, material});
}

void SceneBuilder::add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  scene_.geometry.triangles.push_back({a, b, c});
  ++scene_.geometry.shapes.back().triangle_count;
}

void SceneBuilder::triangle(Vec3d a, Vec3d b, Vec3d c, std::uint32_t material) {
  begin_shape(material);
  const std::uint32_t first = vertex(a);
  vertex(b), vertex(c);
  add(first, first + 1, first + 2);
}

void SceneBuilder::quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d, std::uint32_t material) {
  begin_shape(material);
  const std::uint32_t first = vertex(a);
  vertex(b), vertex(c), vertex(d);
  add(first, first + 1, first + 2);
  add(first, first + 2, first + 3);
}

void SceneBuilder::floor(Vec3d p, double hx, double hy, std::uint32_t material) {
  quad(p + Vec3d{-hx, -hy, 0}, p + Vec3d{hx, -hy, 0}, p + Vec3d{hx, hy, 0}, p + Vec3d{-hx, hy, 0}, material);
}

void SceneBuilder::ceiling(Vec3d p, double hx, double hy, std::uint32_t material) {
  quad(p + Vec3d{-hx, hy, 0}, p + Vec3d{hx, hy, 0}, p + Vec3d{hx, -hy, 0}, p + Vec3d{-hx, -hy, 0}, material);
}

void SceneBuilder::box(Vec3d low, Vec3d high, std::uint32_t material, bool inwards) {
  // Corner i has the high x, y, z where bits 0, 1, 2 are set; each face counter-clockwise from outside.
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const auto corner = [&](int i) {
    return Vec3d{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
  };
  for (const auto& f : kFaces)
    quad(corner(f[0]), corner(f[inwards ? 3 : 1]), corner(f[2]), corner(f[inwards ? 1 : 3]), material);
}

void SceneBuilder::sphere(Vec3d centre, double radius, int levels, std::uint32_t material, bool smooth) {
  begin_shape(material);
  const double g = std::numbers::phi;
  const Vec3d corners[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                             {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<std::uint32_t, 3>> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  std::vector<Vec3d> points;
  for (const Vec3d& c : corners) points.push_back(normalize(c));
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (fresh) points.push_back(normalize(points[a] + points[b]));
      return it->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  const auto first = static_cast<std::uint32_t>(positions_.size());
  for (const Vec3d& p : points) vertex(centre + p * radius, smooth ? p : Vec3d{});
  for (const auto& [a, b, c] : faces) add(first + a, first + b, first + c);
}

void SceneBuilder::camera(Vec3d position, Vec3d target, double yfov_degrees, int width, int height) {
  camera_ = position;
  const Vec3d back = normalize(position - target);
  const Vec3d world_up = std::abs(back.z) < 0.99 ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
  const Vec3d right = normalize(cross(world_up, back));
  Camera& c = scene_.camera;
  c.back = to_float(back), c.right = to_float(right), c.up = to_float(cross(back, right));
  c.tan_half_yfov = static_cast<float>(std::tan(0.5 * yfov_degrees * std::numbers::pi / 180.0));
  c.width = width, c.height = height;
}

SceneBuilder& SceneBuilder::place(double scale, Vec3d offset) {
  for (Vec3d& p : positions_) p = p * scale + offset;
  camera_ = camera_ * scale + offset;
  return *this;
}

SceneBuilder& SceneBuilder::turn(Vec3d axis, double radians) {
  const Vec3d k = normalize(axis);
  const double c = std::cos(radians), sn = std::sin(radians);
  // Rodrigues' formula.
  const auto turned = [&](Vec3d v) { return v * c + cross(k, v) * sn + k * (dot(k, v) * (1.0 - c)); };
  const auto turned_float = [&](Vec3f v) { return to_float(turned(to_double(v))); };
  for (Vec3d& p : positions_) p = turned(p);
  for (Vec3f& n : scene_.geometry.normals) n = turned_float(n);
  Camera& camera = scene_.camera;
  camera_ = turned(camera_);
  camera.right = turned_float(camera.right), camera.up = turned_float(camera.up),
  camera.back = turned_float(camera.back);
  return *this;
}

Scene SceneBuilder::build(Vec3d origin) const {
  Scene scene = scene_;
  for (const Vec3d& p : positions_) scene.geometry.positions.push_back(to_float(p - origin));
  scene.camera.position = to_float(camera_ - origin);
  scene.origin = origin;
  return scene;
}

Material diffuse(const Spectrum& albedo) {
  Material m;
  m.base_color = albedo;
  m.metallic = 0.0f;
  m.specular = 0.0f;
  return m;
}

Material metal(const Spectrum& base, float roughness) {
  Material m;
  m.base_color = base;
  m.roughness = roughness;
  return m;
}

Material plastic(const Spectrum& base, float roughness, float ior) {
  Material m = metal(base, roughness);
  m.metallic = 0.0f;
  m.ior = ior;
  return m;
}

Material thin_glass(float ior, float roughness) {
  Material m = plastic(ConstantSpectrum{1.0}, roughness, ior);
  m.transmission = 1.0f;
  return m;
}

Material solid_glass(float ior, float roughness) {
  Material m = thin_glass(ior, roughness);
  m.thin_walled = false;
  return m;
}

}  // namespace photopic::test
