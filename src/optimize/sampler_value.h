#pragma once

#include "optimize/objective.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// The objective of any sampler, from the spectra themselves rather than from tables in t: quadrature over u,
/// split where a wavelength meets a knot of the lamp or of its density. Slower than ObjectiveFunction, and
/// its judge; here mean_delta_e is not rounded off. [ΔE]
double sampler_value(const WavelengthSampler& sampler, const Targets& targets);

}  // namespace photopic
