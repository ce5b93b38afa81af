#include "core/lights/area_light_lanes.h"

namespace photopic {

AreaLightLanes::AreaLightLanes(const AreaLight& light)
    : vertex(to_lanes(light.vertex)),
      edge1(to_lanes(light.edge1)),
      edge2(to_lanes(light.edge2)),
      normal(to_lanes(light.normal)),
      area(Lanes{} + light.area),
      error(Lanes{} + light.error),
      triangle(UintLanes{} + light.triangle),
      material(UintLanes{} + light.material),
      parallelogram(IntLanes{} - (light.parallelogram ? 1 : 0)),
      double_sided(IntLanes{} - (light.double_sided ? 1 : 0)) {}

AreaLightLanes::AreaLightLanes(const std::array<const AreaLight*, kLanes>& lights) {
  for (int i = 0; i < kLanes; ++i) {
    const AreaLight& light = *lights[static_cast<std::size_t>(i)];
    set_lane(vertex, i, light.vertex);
    set_lane(edge1, i, light.edge1);
    set_lane(edge2, i, light.edge2);
    set_lane(normal, i, light.normal);
    area[i] = light.area, error[i] = light.error;
    triangle[i] = light.triangle, material[i] = light.material;
    parallelogram[i] = light.parallelogram ? -1 : 0, double_sided[i] = light.double_sided ? -1 : 0;
  }
}

IntLanes AreaLightLanes::sample(const Vec3Lanes& from, const Sample2dLanes& u, LightSampleLanes& s) const {
  const Vec3Lanes to_vertex = vertex - from;
  const Lanes h = dot(normal, to_vertex);
  s.reached = (h < 0.0f) | (double_sided & (h > 0.0f));

  const Sample2dLanes folded = sample_triangle(u);
  const Sample2dLanes b{select(parallelogram, u.x, folded.x), select(parallelogram, u.y, folded.y)};
  const Vec3Lanes to_point = to_vertex + edge1 * b.x + edge2 * b.y;
  const Lanes distance2 = dot(to_point, to_point);
  s.distance = sqrt(distance2);
  s.direction = to_point * (1.0f / s.distance);
  s.pdf = distance2 * s.distance / (abs(h) * area);
  const Lanes away = max(error, kPositionError * max_abs(from));  // AreaLight::rounding
  s.end = from + to_point + normal * select(h < 0.0f, away, -away);
  s.delta = s.environment = IntLanes{};
  s.material = material;
  s.triangle = triangle + (reinterpret_cast<UintLanes>(parallelogram & (b.x > b.y)) & 1u);

  const Lanes middle = select(parallelogram, Lanes{} + 0.5f, Lanes{} + 1.0f / 3.0f);
  const Vec3Lanes to_middle = to_vertex + (edge1 + edge2) * middle;
  const Lanes extent2 = max(dot(edge1, edge1), dot(edge2, edge2));
  return s.reached & (dot(to_middle, to_middle) <= AreaLight::kFar2 * extent2) &
         (h * h >= AreaLight::kTouching2 * extent2) & (abs(h) >= away);
}

}  // namespace photopic
