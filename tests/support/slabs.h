#pragma once

#include <cmath>
#include <vector>

#include "core/bsdf/fresnel.h"
#include "support/scene_builder.h"

namespace photopic::test {

/// Glass that keeps a share of light over a metre.
inline Material tinted(float ior, double share, int priority = 0) {
  Material m = solid_glass(ior, 0.0f);
  m.attenuation_color = ConstantSpectrum{share};
  m.attenuation_distance = 1.0f;
  m.priority = priority;
  return m;
}

/// A layer across z, from below; the light comes from above.
struct Layer {
  double ior, thickness, share;
};

/// What a ray downwards at a sine to the normal, in air, meets: Snell, Fresnel, Beer, without reflections.
struct Refracted {
  double offset = 0.0, transmittance = 1.0;
};
inline Refracted refracted(const std::vector<Layer>& layers, double sine) {
  Refracted r;
  double last = 1.0;
  const auto cross_into = [&](double ior) {
    const double cosine = std::sqrt(1.0 - sine * sine / (last * last));
    r.transmittance *= 1.0 - fresnel_dielectric(static_cast<float>(cosine), static_cast<float>(ior / last));
    last = ior;
  };
  for (const Layer& layer : layers) {
    cross_into(layer.ior);
    const double s = sine / layer.ior, c = std::sqrt(1.0 - s * s);
    r.offset += layer.thickness * s / c;
    r.transmittance *= std::pow(layer.share, layer.thickness / c);
  }
  cross_into(1.0);
  return r;
}

}  // namespace photopic::test
