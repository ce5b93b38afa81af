#pragma once

#include <optional>
#include <string>

#include "core/gltf/document.h"
#include "core/scene.h"

namespace photopic {

/// Fills scene.materials, without their emission: one for each glTF material, and glTF's default after them.
/// What is ignored goes to scene.warnings, once each.
/// @throws InputError
void load_gltf_materials(const GltfDocument& document, Scene& scene);

/// The spectrum that an object's `extras` give under `key`: SPECTRUM as text, its files relative to the glTF
/// file, or {"nm": [...], "value": [...]}. Nothing when there is none.
struct ExtrasSpectrum {
  Spectrum spectrum;
  std::string name;
};
std::optional<ExtrasSpectrum> extras_spectrum(const GltfDocument& document, std::size_t material,
                                              const char* key, Beyond beyond);
/// The same for any object. @param pointer JSON pointer of it @param owner as in "of material x"
std::optional<ExtrasSpectrum> extras_spectrum(const GltfDocument& document, const tinygltf::Value& extras,
                                              const std::string& pointer, const std::string& owner,
                                              const char* key, Beyond beyond);

/// What messages call a material: its name in quotation marks, or its number.
std::string quoted_name(const Scene& scene, std::size_t material);

/// A linear sRGB colour as a reflectance; greys are constant, exactly.
Spectrum reflectance_from_rgb(const Rgb& color);

}  // namespace photopic
