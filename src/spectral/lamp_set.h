#pragma once

#include <span>
#include <string>
#include <vector>

#include "spectral/spectrum.h"

namespace photopic {

/// The lamps that light a scene together, in one form whatever the order, the scale and the last digits:
/// equal lamps are merged, dark ones left out, the powers rounded to a hundredth of a decade below the
/// strongest's, the lamps ordered by digest. Of more than twelve the weakest are one lamp. One lamp stays as
/// it is; of several the strongest has unit luminance (∫ȳI dλ / ∫ȳ dλ = 1), the others what they have of its
/// power. Empty when none gives light.
/// @param powers luminous, relative; as many as emissions, of whose scale they are independent
/// @throws std::invalid_argument when a power is negative or not finite, or there are not as many
std::vector<TabulatedSpectrum> lamp_set(std::span<const TabulatedSpectrum> emissions,
                                        std::span<const double> powers);

/// Their sum; a single lamp itself.
TabulatedSpectrum mixed_light(std::span<const TabulatedSpectrum> lamps);

/// Each lamp's part of their luminance, 0 … 1.
std::vector<double> luminance_shares(std::span<const TabulatedSpectrum> lamps);

/// 16 hex digits that identify a lamp_set: the lamps' digests and relative powers. Of a single lamp, its
/// digest.
std::string digest(std::span<const TabulatedSpectrum> lamps);

}  // namespace photopic
