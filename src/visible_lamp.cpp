#include "visible_lamp.h"

#include <stdexcept>

#include "error.h"
#include "spectral/observer.h"

namespace photopic {

TabulatedSpectrum visible_lamp(const Spectrum& spectrum, const std::string& where) {
  try {
    TabulatedSpectrum lamp = tabulate_emission(spectrum);
    if (luminance(lamp) > 0.0) return lamp;
  } catch (const std::invalid_argument& problem) {
    throw InputError(where, problem.what(), "give the spectrum of a lamp");
  }
  throw InputError(where, "gives no visible light between 360 and 830 nm", "give the spectrum of a lamp");
}

}  // namespace photopic
