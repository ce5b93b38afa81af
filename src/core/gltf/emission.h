#pragma once

#include <vector>

#include "core/gltf/document.h"
#include "core/gltf_loader.h"

namespace photopic {

/// Gives the scene's used materials (those of a shape) their emission: emissiveFactor's luminance ×
/// emissiveStrength on the spectrum of an override, else of `extras.emission_spectrum`, else on the colour
/// upsampled on D65.
/// @throws InputError for spectra without light, and for overrides that name no emissive material
void load_gltf_emission(const GltfDocument& document, const std::vector<EmitterOverride>& overrides,
                        Scene& scene);

}  // namespace photopic
