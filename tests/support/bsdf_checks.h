#pragma once

#include <functional>
#include <optional>

#include "core/sample_sequence.h"
#include "core/scene.h"
#include "support/statistics.h"

namespace photopic::test {

/// A BSDF at one wavelength, in the shading frame, whatever its type.
struct LocalBsdf {
  struct Value {
    double f_cos = 0.0, pdf = 0.0;
  };
  struct Sample {
    Vec3f wi;
    double weight, pdf;
    bool delta;
    double eta;
  };
  std::function<Value(Vec3f wo, Vec3f wi)> evaluate;
  std::function<std::optional<Sample>(Vec3f wo, float u_lobe, Sample2d u)> sample;
};

/// The BSDF that shades the material (glass where it transmits), of a path of four wavelengths (450, 500, 550
/// and 600 nm), seen at one of them.
LocalBsdf local_bsdf(const Material& material, int lane = 0);

/// A direction of the given cos θ, its azimuth arbitrary but fixed.
Vec3f direction(double cos_theta);

/// A function on the sphere of directions, two values at once.
using SphereFunction = std::function<LocalBsdf::Value(Vec3f)>;

/// Integrals over cells of the sphere, in rings about an axis that narrow towards it, by adaptive quadrature.
class SphereCells {
 public:
  explicit SphereCells(Vec3f axis);
  std::size_t size() const { return kRings * kSectors; }
  std::size_t cell_of(Vec3f w) const;
  /// ∫ f dω over each cell, to about 1e-6.
  std::vector<LocalBsdf::Value> integrate(const SphereFunction& f) const;

 private:
  static constexpr int kRings = 20, kSectors = 24;
  Vec3f axis_, s_, t_;
};

/// What sampling a BSDF from one direction shows.
struct BsdfReport {
  double chi_square_p;       ///< of where samples fall (failures count too) against evaluate().pdf
  double pdf_integral;       ///< ∫ pdf dω
  double albedo_quadrature;  ///< ∫ f cos dω
  Estimate albedo;           ///< mean weight of samples
  double worst_weight;       ///< largest |weight·pdf − f_cos| / f_cos over the samples
  double worst_pdf;          ///< largest |sample's pdf − evaluate's| / the latter
};
/// For a BSDF without delta lobes. @param axis the direction its lobe points to
BsdfReport examine(const LocalBsdf& bsdf, Vec3f wo, Vec3f axis, int samples, std::uint32_t seed);

/// The mean of weight·(eta² if `scaled`) over samples: the share of energy that goes on.
Estimate sampled_albedo(const LocalBsdf& bsdf, Vec3f wo, int samples, bool scaled = false);

/// What a white furnace shows from one direction.
struct Furnace {
  Estimate albedo;  ///< the mean weight of samples, scaled by the squared index ratio where light crosses
  double variance;  ///< of those weights
  double largest;   ///< of them
};
/// Over eight scrambled sequences, every lobe at every point, for an error far below that of independent
/// samples: until it is below 0.001 and three times it tell whether the albedo is within 0.005 of 1, or 2^21
/// samples are taken.
/// @param ior of what is below the surface, where light refracts into it
Furnace furnace(const LocalBsdf& bsdf, Vec3f wo, double ior = 1.0);

}  // namespace photopic::test
