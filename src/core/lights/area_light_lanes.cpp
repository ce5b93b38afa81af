#include "core/lights/area_light_lanes.h"

#include <cstddef>
#include <cstring>

#include "core/lights/light_view.h"

namespace photopic {
namespace {

/// LightSampleLanes' part that is geometry.
struct AreaSamples {
  IntLanes reached;
  Vec3Lanes direction, end;
  Lanes distance, pdf;
  IntLanes in_first;  ///< mask: the point is on the triangle of edge1, should the light have two
};

AreaSamples sample_by_area(const AreaLightLanes& light, const LightView<Lanes>& view,
                           const Sample2dLanes& u) {
  const Sample2dLanes folded = sample_triangle(u);
  const Lanes x = select(light.parallelogram, u.x, folded.x), y = select(light.parallelogram, u.y, folded.y);
  const Vec3Lanes to_point = view.to_vertex + light.edge1 * x + light.edge2 * y;
  const Lanes distance = length(to_point);
  return {view.height != 0.0f,
          to_point * (1.0f / distance),
          view.end(light, to_point),
          distance,
          view.pdf_by_area(light, distance),
          x > y};
}

AreaSamples sample_by_solid_angle(const AreaLightLanes& light, const LightView<Lanes>& view,
                                  const Sample2dLanes& u) {
  const auto outline = view.outline(light);
  const auto way = outline.sample(u);
  const Lanes cosine = dot(light.normal, way.direction), distance = view.height / cosine;
  const Lanes solid_angle = outline.solid_angle();
  const IntLanes reached = (cosine * view.height > 0.0f) & (solid_angle > 0.0f);
  return {reached,  way.direction,      view.end(light, way.direction * distance),
          distance, 1.0f / solid_angle, way.in_first};
}

/// Points of lights that shine to where they are seen from.
AreaSamples sample_area_lights(const AreaLightLanes& light, const Vec3Lanes& from, const Sample2dLanes& u) {
  const LightView<Lanes> view(light, from);
  AreaSamples s = sample_by_area(light, view, u);
  if (const IntLanes looms = view.looms(light); any(looms)) {
    const AreaSamples near = sample_by_solid_angle(light, view, u);
    s = {select(looms, near.reached, s.reached), select(looms, near.direction, s.direction),
         select(looms, near.end, s.end),         select(looms, near.distance, s.distance),
         select(looms, near.pdf, s.pdf),         select(looms, near.in_first, s.in_first)};
  }
  s.reached = s.reached & ((view.height < 0.0f) | light.double_sided);
  return s;
}

}  // namespace

AreaLightLanes::AreaLightLanes(const AreaLight& light)
    : vertex(broadcast<Lanes>(light.vertex)),
      edge1(broadcast<Lanes>(light.edge1)),
      edge2(broadcast<Lanes>(light.edge2)),
      normal(broadcast<Lanes>(light.normal)),
      area(Lanes{} + light.area),
      error(Lanes{} + light.error),
      triangle(UintLanes{} + light.triangle),
      material(UintLanes{} + light.material),
      parallelogram(IntLanes{} - (light.parallelogram ? 1 : 0)),
      double_sided(IntLanes{} - (light.double_sided ? 1 : 0)) {}

AreaLightLanes::AreaLightLanes(const std::array<const AreaLight*, kLanes>& lights) {
  // A light is a line of sixteen numbers.
  LaneMatrix lines;
  static_assert(sizeof(AreaLight) == sizeof(Lanes) && offsetof(AreaLight, triangle) == 14 * sizeof(float));
  for (std::size_t i = 0; i < kLanes; ++i) std::memcpy(&lines[i], lights[i], sizeof(Lanes));
  const LaneMatrix number = transpose(lines);
  vertex = {number[0], number[1], number[2]};
  edge1 = {number[3], number[4], number[5]};
  edge2 = {number[6], number[7], number[8]};
  normal = {number[9], number[10], number[11]};
  area = number[12], error = number[13];
  triangle = reinterpret_cast<UintLanes>(number[14]);
  // GCC and clang fill bit-fields from the lowest bit.
  const auto bits = reinterpret_cast<UintLanes>(number[15]);
  material = bits & 0x3fffffffu;
  parallelogram = (bits & (1u << 30)) != 0u, double_sided = (bits & (1u << 31)) != 0u;
}

void AreaLightLanes::sample(const Vec3Lanes& from, const Sample2dLanes& u, LightSampleLanes& s) const {
  const AreaSamples point = sample_area_lights(*this, from, u);
  s.reached = point.reached;
  s.direction = point.direction, s.end = point.end;
  s.distance = point.distance, s.pdf = point.pdf;
  s.delta = s.environment = IntLanes{};
  s.material = material;
  s.triangle = triangle + (reinterpret_cast<UintLanes>(parallelogram & point.in_first) & 1u);
}

}  // namespace photopic
