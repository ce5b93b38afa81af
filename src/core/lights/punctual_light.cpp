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

/// The mean over the sphere of what is 1 within a spot's inner cone and has a mean over the rim.
double mean_over_sphere(const PunctualLight& spot, double mean_over_rim) {
  const double width = std::min(rim(spot), 1.0f - spot.cos_outer), inside = 1.0 - spot.cos_outer - width;
  return 0.5 * (inside + width * mean_over_rim);
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

double PunctualLight::rms_intensity() const {
  return kind == Kind::spot ? intensity * std::sqrt(mean_over_sphere(*this, 1.0 / 5.0)) : intensity;
}

double PunctualLight::power(double scene_radius) const {
  constexpr double kPiD = std::numbers::pi;
  switch (kind) {
    case Kind::point:
      return 4.0 * kPiD * intensity;
    case Kind::spot:  // over the rim the attenuation is a square law in the cosine
      return 4.0 * kPiD * intensity * mean_over_sphere(*this, 1.0 / 3.0);
    case Kind::directional:
      return kPiD * scene_radius * scene_radius * intensity;
  }
  return 0.0;
}

}  // namespace photopic
