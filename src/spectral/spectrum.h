#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "spectral/guide_table.h"
#include "spectral/rgb_upsampling.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

/// A function of wavelength. (Its values at a path's N wavelengths are another type, SampledSpectrum.)

struct ConstantSpectrum {
  double value = 1.0;
};

/// Planck's law [relative, 1 at 560 nm], c₂ = hc/k from the SI's exact constants (CODATA 2018).
struct BlackbodySpectrum {
  double kelvin = 6500.0;
};

/// A triangular line of unit peak: zero at centre ± fwhm.
struct LineSpectrum {
  double centre = 550.0;  ///< [nm]
  double fwhm = 1.0;      ///< full width at half maximum [nm], > 0
};

/// What a table says beyond its first and last knot: an emission is zero, a reflectance keeps its end values.
enum class Beyond { zero, end_value };

/// Piecewise linear between knots; two knots at one wavelength are a jump, and the wavelength itself takes
/// the second knot's value. Looked up through an index of cells, so that a look-up costs the same for 2 knots
/// and for 100,000.
class TabulatedSpectrum {
 public:
  /// @param lambda knots [nm], non-decreasing, at most two at the same place, at least one
  /// @param value  finite values, as many
  /// @throws std::invalid_argument where that is not so
  TabulatedSpectrum(std::vector<double> lambda, std::vector<double> value, Beyond beyond);

  double operator()(double lambda) const;

  /// One-sided limits: they differ at a jump, and at the ends of an emission, which is zero beyond.
  double limit_from_left(double lambda) const;
  double limit_from_right(double lambda) const;

  std::span<const double> lambda() const { return lambda_; }
  std::span<const double> value() const { return value_; }

  TabulatedSpectrum scaled(double factor) const;

 private:
  double outside(double end_value) const { return beyond_ == Beyond::zero ? 0.0 : end_value; }

  std::vector<double> lambda_, value_;
  Beyond beyond_;
  GuideTable cell_of_;  ///< of the cells between knots
};

using Spectrum =
    std::variant<ConstantSpectrum, TabulatedSpectrum, BlackbodySpectrum, LineSpectrum, SigmoidPolynomial>;

/// The spectrum's value at a wavelength [nm].
double evaluate(const Spectrum& spectrum, double lambda);

/// The lamp as the renderer and the optimiser know it: piecewise linear, first knot 360 nm, last 830 nm, zero
/// outside. Tables and lines keep their knots (cut at the ends of the range; where a table begins or ends
/// inside it, a jump to zero); smooth spectra are tabulated every nm. All zero where the lamp gives no power
/// in the range: callers check. Its scale is the lamp's, but where that is beyond 1e±100 the largest is 1
/// to 2.
/// @throws std::invalid_argument when a value is negative or not finite, or a line has no width
TabulatedSpectrum tabulate_emission(const Spectrum& spectrum);

/// Σ weight·emission, on the union of their knots; jumps stay jumps.
/// @throws std::invalid_argument when a weight is negative or not finite, or there are not as many
TabulatedSpectrum mix_emissions(std::span<const TabulatedSpectrum> emissions,
                                std::span<const double> weights);

/// The product of an emission and a reflectance (for RGB emission: its upsampling on D65) as an emission on
/// [360, 830] nm: exact at both's knots and at every nm, linear in between.
/// @throws std::invalid_argument when a product is negative or not finite
TabulatedSpectrum tabulate_product(const Spectrum& a, const Spectrum& b);

/// 16 hex digits that identify a table's knots and values up to scale; the same on every machine: FNV-1a (64
/// bit) over the knots to 1e-6 nm and the values to 1e-7 of the largest.
std::string digest(const TabulatedSpectrum& spectrum);

}  // namespace photopic
