#include "core/lights/punctual_light.h"

#include <limits>
#include <numbers>

namespace photopic {
namespace {

/// The narrowest rim between a spot's cones, in cosines: a hard edge must not divide by zero. (The 0.001 of
/// the extension's sample code would leave a spot of 1° with 2 % of its intensity.)
constexpr float kNarrowestRim = 1e-6f;

float rim(const PunctualLight& light) {
  return std::max(kNarrowestRim, light.cos_inner - light.cos_outer);
}

}  // namespace

float PunctualLight::attenuation(float cosine) const {
  return sqr(std::clamp((cosine - cos_outer) / rim(*this), 0.0f, 1.0f));
}

std::optional<LightSample> PunctualLight::sample(Vec3f from) const {
  LightSample s{};
  s.pdf = 1.0f;
  s.delta = true;
  s.spectrum = emission_spectrum;
  if (kind == Kind::directional) {
    s.direction = -direction;
    s.distance = std::numeric_limits<float>::infinity();
    s.radiance = intensity;
    return s;
  }
  const Vec3f to_light = position - from;
  s.distance = length(to_light);
  if (!(s.distance > 0.0f)) return {};
  s.direction = to_light / s.distance;
  s.end = position;
  s.radiance = intensity / s.distance / s.distance;
  if (kind == Kind::spot) s.radiance *= attenuation(-dot(s.direction, direction));
  if (!(s.radiance > 0.0f)) return {};
  return s;
}

double PunctualLight::power(double scene_radius) const {
  constexpr double kPiD = std::numbers::pi;
  switch (kind) {
    case Kind::point:
      return 4.0 * kPiD * intensity;
    case Kind::spot: {
      // ∫ attenuation dω: a square law in the cosine over the rim, 1 inside.
      const double width = std::min(rim(*this), 1.0f - cos_outer), inside = 1.0 - cos_outer - width;
      return 2.0 * kPiD * intensity * (inside + width / 3.0);
    }
    case Kind::directional:
      return kPiD * scene_radius * scene_radius * intensity;
  }
  return 0.0;
}

}  // namespace photopic
