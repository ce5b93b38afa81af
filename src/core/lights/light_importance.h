#pragma once

#include "core/lights/light.h"
#include "core/lights/light_bounds.h"

namespace photopic {

/// What a light tree knows of a branch, or of sixteen.
template <typename T>
struct LightBranch {
  T intensity;     ///< of all lights: 1
  Vec3<T> middle;  ///< of the sphere about the box
  T radius;        ///< of that [m]
  Vec3<T> axis;
  T cos_o, sin_o, cos_e;
  T other_side;  ///< −1: shines along −axis too; else 1
};

/// Squared distance [m²] that keeps importances finite.
inline constexpr float kLeastDistance2 = 1e-30f;

/// What may arrive from each at most, roughly: intensity / distance² × the cosines at both ends, each at its
/// most favourable within the sphere about the box: Conty Estevez & Kulla 2018, section 4.2. Where the sphere
/// lies below the surface's plane, nothing. Of sixteen branches at one point, or of one at sixteen.
template <typename B, typename P>
Lanes importance(const LightBranch<B>& branch, const BasicLightReference<P>& at) {
  const Lanes zero{}, one = zero + 1.0f;
  const Lanes dx = branch.middle.x - at.position.x, dy = branch.middle.y - at.position.y,
              dz = branch.middle.z - at.position.z;
  // Within the sphere its radius is the distance.
  const Lanes to_middle2 = dx * dx + dy * dy + dz * dz, radius2 = zero + branch.radius * branch.radius;
  const IntLanes inside = to_middle2 <= radius2;
  const Lanes inverse = 1.0f / sqrt(max(max(to_middle2, radius2), zero + kLeastDistance2));
  // Half the angle that the sphere subtends.
  const Lanes sin_b = branch.radius * inverse, sin2_b = sin_b * sin_b;

  const P all_around = select(dot(at.normal, at.normal) == 0.0f, P{} + 1.0f, P{});
  const Lanes height = (at.normal.x * dx + at.normal.y * dy + at.normal.z * dz) * inverse;
  const Lanes cos_surface = max(min(height + sin_b + all_around, one), zero);

  // At the light: the angle to the axis, less the cone's and the sphere's.
  const Lanes along = -(branch.axis.x * dx + branch.axis.y * dy + branch.axis.z * dz) * inverse;
  const Lanes cos_w = max(along, along * branch.other_side), sin_w = sqrt(max(1.0f - cos_w * cos_w, zero));
  const IntLanes in_cone = cos_w >= branch.cos_o;
  const Lanes cos_x = select(in_cone, one, cos_w * branch.cos_o + sin_w * branch.sin_o);
  const Lanes sin_x = select(in_cone, zero, sin_w * branch.cos_o - cos_w * branch.sin_o);
  // 1 − sin² ≤ cos ≤ 1 − sin²/2: the bound that lets no light seem to set early.
  const Lanes cos_b = one - select(cos_x < 0.0f, sin2_b, 0.5f * sin2_b);
  const Lanes cos_light = select(inside | (cos_x >= cos_b), one, min(cos_x * cos_b + sin_x * sin_b, one));
  const Lanes shines = select(cos_light > branch.cos_e, max(cos_light, zero), zero);
  return branch.intensity * cos_surface * shines * (inverse * inverse);
}

}  // namespace photopic
