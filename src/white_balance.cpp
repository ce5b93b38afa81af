#include "white_balance.h"

#include <stdexcept>

#include "error.h"
#include "spectral/illuminants.h"
#include "spectral/spectrum_file.h"

namespace photopic {

ChromaticAdaptation white_balance(const std::string& spectrum, const Observer& observer,
                                  const PreparedScene& scene) {
  if (spectrum.empty() && &observer == &Observer::cie1931()) return {};
  const auto read = [&] {
    try {
      return parse_spectrum(spectrum, {}, Beyond::zero);
    } catch (const InputError& error) {
      throw InputError("--white-balance " + spectrum, error.what(),
                       "or give illuminant, for the scene's lamps");
    }
  };
  try {
    const TabulatedSpectrum white = spectrum == "illuminant" ? scene_emission(scene)
                                    : spectrum.empty()       ? cie_illuminant("D65").value()
                                                             : tabulate_emission(read());
    return {emission_xyz(white, observer), d65_white()};
  } catch (const std::invalid_argument& error) {
    throw InputError("--white-balance " + spectrum, error.what(), "choose a white light, as cie:D50");
  }
}

}  // namespace photopic
