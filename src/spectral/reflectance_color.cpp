#include "spectral/reflectance_color.h"

#include "spectral/illuminants.h"
#include "spectral/observer.h"

namespace photopic {

Rgb color_under_d65(const Spectrum& reflectance) {
  if (const auto* grey = std::get_if<ConstantSpectrum>(&reflectance))
    return {grey->value, grey->value, grey->value};
  static const TabulatedSpectrum d65 = tabulate_emission(cie_illuminant("D65").value());
  static const double white = emission_xyz(d65, Observer::cie1931()).y;
  return xyz_to_linear_srgb(emission_xyz(tabulate_product(reflectance, d65), Observer::cie1931()) *
                            (1.0 / white));
}

}  // namespace photopic
