#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "spectral/spectrum.h"

namespace photopic {

/// The reflectances that an optimisation aims at: R = 1 first, then count − 1 sigmoid polynomials (Jakob &
/// Hanika 2019) whose colours under D65 spread evenly over the sRGB cube, evenly as encoded and so roughly as
/// seen. The colours are an additive recurrence in three dimensions (Roberts 2018, R_3), rotated by the seed:
/// any count covers the whole cube. Measured reflectances (test-colour samples, ColorChecker) are left out on
/// purpose: they judge the result.
/// @param count ≥ 1
std::vector<Spectrum> target_reflectances(int count, std::uint64_t seed);

/// Reflectances to judge a result by: sigmoid polynomials of colours drawn independently, evenly over the
/// sRGB cube as encoded, always the same ones; no target is among them.
std::vector<Spectrum> test_reflectances(int count);

/// 16 hex digits that identify measured reflectances by their values at every nm, to 1e-7; empty for none.
std::string reflectances_digest(std::span<const Spectrum> reflectances);

}  // namespace photopic
