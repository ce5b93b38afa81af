#include "spectral/rgb_light.h"

namespace photopic {

const std::array<SigmoidPolynomial, 6>& rgb_tints() {
  static const std::array<SigmoidPolynomial, 6> tints = {
      upsample_reflectance({1, 0, 0}), upsample_reflectance({0, 1, 0}), upsample_reflectance({0, 0, 1}),
      upsample_reflectance({0, 1, 1}), upsample_reflectance({1, 0, 1}), upsample_reflectance({1, 1, 0})};
  return tints;
}

}  // namespace photopic
