#include "core/lights/area_light_lanes.h"

#include <cstddef>
#include <cstring>

#include "core/lights/area_sampling.h"

namespace photopic {

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
  const AreaSample<Lanes> point = sample_area_light(*this, from, u);
  s.reached = point.reached;
  s.direction = point.direction, s.end = point.end;
  s.distance = point.distance, s.pdf = point.pdf;
  s.delta = s.environment = IntLanes{};
  s.material = material;
  s.triangle = triangle + (reinterpret_cast<UintLanes>(parallelogram & point.in_first) & 1u);
}

}  // namespace photopic
