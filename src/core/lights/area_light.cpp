#include "core/lights/area_light.h"

#include <numbers>
#include <optional>

#include "core/lights/light_view.h"
#include "core/surface_point.h"

namespace photopic {
namespace {

using Corners = std::array<Vec3f, 3>;

Corners corners_of(const Geometry& geometry, std::uint32_t triangle) {
  const auto& [a, b, c] = geometry.triangles[triangle];
  return {geometry.positions[a], geometry.positions[b], geometry.positions[c]};
}

/// How many points an edge it takes to see what varies over a triangle: one a texel, within reason.
int steps_across(const Geometry& geometry, const Surface& surface, std::uint32_t triangle) {
  constexpr float kMost = 64.0f;
  float texels = 2.0f;  // vertex colours are linear
  const auto add = [&](const Texture& texture) {
    if (!texture) return;
    const auto corner = [&](float u, float v) {
      return texture.transform(TrianglePoint(geometry, triangle, u, v).uv(texture.uv_set));
    };
    const Vec2f a = corner(0, 0), b = corner(1, 0), c = corner(0, 1);
    const auto extent = [](float x, float y, float z) { return std::max({x, y, z}) - std::min({x, y, z}); };
    texels = std::max({texels, extent(a.x, b.x, c.x) * static_cast<float>(texture.image->width),
                       extent(a.y, b.y, c.y) * static_cast<float>(texture.image->height)});
  };
  if (surface.textures) {
    add(surface.textures->emissive);
    if (surface.partly_covers) add(surface.textures->base_color);
  }
  return texels < kMost ? static_cast<int>(std::ceil(texels)) : static_cast<int>(kMost);
}

/// The mean luminance over a triangle on which emission or coverage vary, from points spread evenly over
/// it.
float luminance_of(const Scene& scene, std::span<const Surface> surfaces, std::uint32_t material,
                   std::uint32_t triangle) {
  const float luminance = scene.materials[material].emission_luminance;
  const Surface& surface = surfaces[material];
  if (!surface.emission_varies && !surface.partly_covers) return luminance;
  const int steps = steps_across(scene.geometry, surface, triangle);
  const float third = 1.0f / 3.0f, step = 1.0f / static_cast<float>(steps);
  float sum = 0.0f;
  int count = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; i + j < steps; ++j, ++count) {
      const float u = (static_cast<float>(i) + third) * step, v = (static_cast<float>(j) + third) * step;
      const TrianglePoint point(scene.geometry, triangle, u, v);
      const float tint = surface.emission_varies ? photopic::luminance(surface.emissive_rgb(point)) : 1.0f;
      sum += tint * surface.coverage(point);
    }
  }
  return luminance * sum / static_cast<float>(count);
}

/// A corner and its edges, the front where edge1 × edge2 points.
struct Outline {
  Vec3f vertex, edge1, edge2;
};

/// Of two triangles that share an edge and make a parallelogram: a corner on the shared edge, so that the
/// half on edge1 is the second triangle.
std::optional<Outline> parallelogram(const Corners& first, const Corners& second, float error) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3f apex1 = first[i], s1 = first[(i + 1) % 3], s2 = first[(i + 2) % 3], apex2 = second[j];
      if (second[(j + 1) % 3] != s2 || second[(j + 2) % 3] != s1) continue;
      if (max_abs((s1 - apex1) + (s2 - apex2)) > error) return {};
      return Outline{s1, apex2 - s1, apex1 - s1};
    }
  }
  return {};
}

std::optional<AreaLight> make_light(const Outline& outline, bool whole, float error, bool double_sided,
                                    std::uint32_t material, std::uint32_t triangle) {
  const Vec3d n = cross(to_double(outline.edge1), to_double(outline.edge2));
  const double area = length(n) * (whole ? 1.0 : 0.5);
  if (!(area > 0.0)) return {};
  const Vec3f e1 = outline.edge1, e2 = outline.edge2;
  const float shrink = shrink_to_middle(error, std::max(max_abs(e1), max_abs(e2)));
  return AreaLight{.vertex = outline.vertex + (e1 + e2) * (shrink * (whole ? 0.5f : 1.0f / 3.0f)),
                   .edge1 = e1 * (1.0f - shrink),
                   .edge2 = e2 * (1.0f - shrink),
                   .normal = to_float(normalize(n)),
                   .area = static_cast<float>(area),
                   .error = error,
                   .triangle = triangle,
                   .material = material & 0x3fffffffu,
                   .parallelogram = whole,
                   .double_sided = double_sided};
}

}  // namespace

float AreaLight::pdf(Vec3f from, float distance) const {
  const LightView<float> view(*this, from);
  if (view.height == 0.0f) return 0.0f;
  if (!view.looms(*this)) return view.pdf_by_area(*this, distance);
  const float solid_angle = view.outline(*this).solid_angle();
  return solid_angle > 0.0f ? 1.0f / solid_angle : 0.0f;
}

double AreaLights::power(std::uint32_t light) const {
  const AreaLight& l = lights_[light];
  return std::numbers::pi * mean_luminance_[light] * l.area * (l.double_sided ? 2.0 : 1.0);
}

AreaLights::AreaLights(const Scene& scene, std::span<const Surface> surfaces) {
  const Geometry& geometry = scene.geometry;
  for (const Material& m : scene.materials) emissions_.push_back({m.emission_luminance, m.emission_spectrum});
  const auto error_of = [](const Corners& c) { return position_error(c[0], c[1], c[2]); };
  for (const Shape& shape : geometry.shapes) {
    offset_of_shape_.push_back(shape.first_triangle - static_cast<std::uint32_t>(light_of_triangle_.size()));
    const Material& material = scene.materials[shape.material];
    if (material.emission_spectrum < 0 || !(material.emission_luminance > 0.0f)) continue;
    for (std::uint32_t i = 0; i < shape.triangle_count; ++i) {
      const std::uint32_t triangle = shape.first_triangle + i;
      const Corners corners = corners_of(geometry, triangle);
      const float error = error_of(corners);
      std::optional<Outline> whole;
      if (i + 1 < shape.triangle_count)
        whole = parallelogram(corners, corners_of(geometry, triangle + 1), error);
      const Outline half{corners[0], corners[1] - corners[0], corners[2] - corners[0]};
      const auto light = make_light(whole.value_or(half), whole.has_value(), error, material.double_sided,
                                    shape.material, triangle);
      const auto index = static_cast<std::uint32_t>(lights_.size());
      light_of_triangle_.insert(light_of_triangle_.end(), whole ? 2 : 1, light ? index : kNoLight);
      if (light) {
        float mean = luminance_of(scene, surfaces, shape.material, triangle);
        if (whole) mean = 0.5f * (mean + luminance_of(scene, surfaces, shape.material, triangle + 1));
        lights_.push_back(*light);
        mean_luminance_.push_back(mean);
      }
      if (whole) ++i;
    }
  }
}

}  // namespace photopic
