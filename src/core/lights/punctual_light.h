#pragma once

#include <optional>
#include <string>

#include "core/lights/light.h"

namespace photopic {

/// A light of KHR_lights_punctual: without extent, so only next-event estimation finds it.
struct PunctualLight {
  enum class Kind { point, spot, directional };
  Kind kind = Kind::point;
  Vec3f position{};            ///< relative to Scene::origin [m]
  Vec3f direction{0, 0, -1};   ///< that it shines in, unit
  float cos_inner = 1.0f;      ///< of a spot's cone that is fully bright (half angle)
  float cos_outer = 0.0f;      ///< of the cone beyond which it is dark
  float intensity = 0.0f;      ///< along the direction [cd]; directional: illuminance facing it [lx]
  int emission_spectrum = -1;  ///< index into Scene::emission_spectra
  std::string name{};          ///< the light's, else its node's
  int index = -1;              ///< in the file's list; −1: in none

  /// A spot's angular attenuation, 0 … 1: KHR_lights_punctual, "Inner and Outer Cone Angles".
  float attenuation(float cosine) const;

  /// Nothing where it does not shine; the probability of choosing it is for the caller to fill in.
  std::optional<LightSample> sample(Vec3f from) const;

  /// The root mean square over all directions [cd]; not of a directional light. By that a light is best
  /// chosen where it is not known whether it shines there: of what is to be summed the variance is least when
  /// terms are sampled in proportion to their root mean squares.
  double rms_intensity() const;

  /// Luminous flux [lm]; of a directional light that through a disc of the radius [m].
  double power(double scene_radius) const;
};

}  // namespace photopic
