#pragma once

#include <array>
#include <span>

#include "spectral/color.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

class TabulatedSpectrum;

/// Colour matching functions of a CIE standard observer: tables at 1 nm from 360 to 830 nm, linear in
/// between, zero outside. CIE 1931 2°: CIE 018:2019, table 6; CIE 1964 10°: CIE 015:2018.
class Observer {
 public:
  static constexpr int kTableSize = 471;  ///< 360, 361, … 830 nm
  using Table = std::array<double, kTableSize>;

  static const Observer& cie1931();
  static const Observer& cie1964();

  Observer(const Table& x_bar, const Table& y_bar, const Table& z_bar);

  /// (x̄, ȳ, z̄) at a wavelength [nm].
  Xyz operator()(double lambda) const {
    const double position = lambda - kLambdaMin;
    if (!(position >= 0.0 && position <= kTableSize - 1)) return {};
    const int i = position < kTableSize - 1 ? static_cast<int>(position) : kTableSize - 2;
    const double f = position - i;
    return table_[i] * (1.0 - f) + table_[i + 1] * f;
  }

  /// ∫ȳ dλ [nm], derived from the table; XYZ = ∫ h·radiance dλ / ∫ȳ dλ.
  double y_integral() const { return y_integral_; }

 private:
  std::array<Xyz, kTableSize> table_;
  double y_integral_;
};

/// Of light of 555 nm [lm/W]: CIE 018:2019.
inline constexpr double kMaximalEfficacy = 683.002;

/// XYZ of an emission: ∫ h·I dλ / ∫ȳ dλ, exact for piecewise linear I (every product is quadratic in a cell).
/// Beyond its knots the emission is taken for zero, whatever its table says there.
Xyz emission_xyz(const TabulatedSpectrum& emission, const Observer& observer);

/// Y of that by the CIE 1931 observer.
double luminance(const TabulatedSpectrum& emission);

}  // namespace photopic
