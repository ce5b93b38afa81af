#pragma once

#include "core/gltf/document.h"
#include "core/scene.h"
#include "spectral/color.h"

namespace photopic {

/// An extension's members, their types and ranges already checked; absent ones have glTF's defaults.
class Extension {
 public:
  Extension(const tinygltf::Material& material, const char* name) {
    const auto found = material.extensions.find(name);
    if (found != material.extensions.end()) value_ = &found->second;
  }
  explicit operator bool() const { return value_ != nullptr; }
  bool has(const char* key) const { return value_ && value_->Has(key); }
  float number(const char* key, double otherwise) const {
    return static_cast<float>(has(key) ? value_->Get(key).GetNumberAsDouble() : otherwise);
  }
  Rgb color(const char* key, const Rgb& otherwise = {1, 1, 1}) const {
    if (!has(key)) return otherwise;
    const auto component = [&](int i) { return value_->Get(key).Get(i).GetNumberAsDouble(); };
    return {component(0), component(1), component(2)};
  }

 private:
  const tinygltf::Value* value_ = nullptr;
};

/// Whether some of the material transmits; metals do not.
bool has_glass(const tinygltf::Material& source, const Material& material);

/// Fills material.extensions from glTF's extensions and from `extras`: "conductor", a metal's name; "glass",
/// a glass's name or {"cauchy": [A, B in µm²]}. Glass by extras transmits and, unless KHR_materials_volume
/// says otherwise, is solid. "solid", true or false, overrules that; "priority" is a whole number. The rest
/// of the material must have been loaded. A "conductor" beside glass or a measured reflectance is refused.
/// @throws InputError
void load_material_extensions(const GltfDocument& document, std::size_t index, Material& material);

}  // namespace photopic
