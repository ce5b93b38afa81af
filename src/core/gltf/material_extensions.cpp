#include "core/gltf/material_extensions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/gltf/material.h"

namespace photopic {
namespace {

constexpr int kMaxPriority = 1'000'000;

std::string extras_pointer(std::size_t index, const char* key) {
  return fmt::format("/materials/{}/extras/{}", index, key);
}

/// The value of a material's extras under `key`; null when there is none.
const tinygltf::Value* extra(const GltfDocument& document, std::size_t index, const char* key) {
  const tinygltf::Value& extras = document.model.materials[index].extras;
  return extras.IsObject() && extras.Has(key) ? &extras.Get(key) : nullptr;
}

/// A text, fit for a message; empty where the value is a number, say.
std::string name_in(const tinygltf::Value& value) {
  return value.IsString() ? value.Get<std::string>().substr(0, 60) : std::string();
}

void load_conductor(const GltfDocument& document, std::size_t index, Material& material) {
  const tinygltf::Value* value = extra(document, index, "conductor");
  if (value == nullptr) return;
  if (has_glass(document.model.materials[index], material))
    document.fail(extras_pointer(index, "conductor"), "the material has KHR_materials_transmission, too",
                  "take one of them out");
  if (extra(document, index, "reflectance_spectrum") != nullptr)
    document.fail(extras_pointer(index, "reflectance_spectrum"), "the material has a \"conductor\", too",
                  "take one of them out");
  const std::string name = name_in(*value);
  material.extensions.conductor = conductor_index(name);
  if (!material.extensions.conductor)
    document.fail(
        extras_pointer(index, "conductor"),
        name.empty() ? "this is not the name of a metal" : fmt::format("\"{}\" is not a known metal", name),
        fmt::format("choose one of {}", fmt::join(conductor_names(), ", ")));
}

DielectricIndex cauchy(const GltfDocument& document, std::size_t index, const tinygltf::Value& value) {
  const auto number = [&](int i) {
    return value.Get(i).IsNumber() ? value.Get(i).GetNumberAsDouble() : -1.0;
  };
  const bool good = value.IsArray() && value.ArrayLen() == 2 && number(0) >= 1.0 && number(0) <= 100.0 &&
                    number(1) >= 0.0 && number(1) <= 1.0;
  if (!good)
    document.fail(extras_pointer(index, "glass"),
                  "\"cauchy\" is not a pair of A, 1 to 100, and B, 0 to 1 µm²",
                  "write {\"cauchy\": [1.5046, 0.0042]} for BK7");
  return CauchyIndex{number(0), 1e6 * number(1)};
}

void load_glass(const GltfDocument& document, std::size_t index, Material& material) {
  const tinygltf::Value* value = extra(document, index, "glass");
  if (value == nullptr) return;
  if (extra(document, index, "conductor") != nullptr)
    document.fail(extras_pointer(index, "glass"), "the material has a \"conductor\", too",
                  "take one of them out");
  const std::string name = name_in(*value);
  std::optional<DielectricIndex> glass = glass_index(name);
  if (value->IsObject() && value->Has("cauchy")) glass = cauchy(document, index, value->Get("cauchy"));
  if (!glass)
    document.fail(
        extras_pointer(index, "glass"),
        name.empty() ? "this is not the name of a glass" : fmt::format("\"{}\" is not a known glass", name),
        fmt::format("choose one of {}, or write {{\"cauchy\": [A, B]}}", fmt::join(glass_names(), ", ")));
  const tinygltf::Material& source = document.model.materials[index];
  material.extensions.dispersion = glass;
  material.ior = static_cast<float>(refractive_index(*glass, kLineD));
  if (!Extension(source, "KHR_materials_transmission"))
    material.transmission = 1.0f, material.metallic = 0.0f;
  if (!Extension(source, "KHR_materials_volume").has("thicknessFactor")) material.thin_walled = false;
}

/// "solid" says what KHR_materials_volume's thickness says, and overrules it.
void load_medium(const GltfDocument& document, std::size_t index, Material& material) {
  if (const tinygltf::Value* solid = extra(document, index, "solid")) {
    if (!solid->IsBool())
      document.fail(extras_pointer(index, "solid"), "is neither true nor false",
                    "true makes transmission refract, false thin-walled");
    material.thin_walled = !solid->Get<bool>();
  }
  if (const tinygltf::Value* priority = extra(document, index, "priority")) {
    const double value = priority->IsNumber() ? priority->GetNumberAsDouble() : 0.5;
    if (value != std::round(value) || std::abs(value) > kMaxPriority)
      document.fail(extras_pointer(index, "priority"),
                    fmt::format("is not a whole number from -{} to {}", kMaxPriority, kMaxPriority),
                    "where glasses overlap, the one of the highest is there");
    material.priority = static_cast<int>(value);
  }
}

void load_dispersion(const tinygltf::Material& source, Material& material) {
  const float dispersion = Extension(source, "KHR_materials_dispersion").number("dispersion", 0.0);
  if (dispersion > 0.0f && material.ior >= 1.0f)
    material.extensions.dispersion = abbe_index(material.ior, dispersion);
}

void load_coats(const tinygltf::Material& source, MaterialExtensions& x) {
  const Extension clearcoat(source, "KHR_materials_clearcoat"), sheen(source, "KHR_materials_sheen");
  x.clearcoat = clearcoat.number("clearcoatFactor", 0.0);
  x.clearcoat_roughness = clearcoat.number("clearcoatRoughnessFactor", 0.0);
  x.sheen_color = reflectance_from_rgb(sheen.color("sheenColorFactor", {0, 0, 0}));
  x.sheen_roughness = sheen.number("sheenRoughnessFactor", 0.0);
}

void load_surface(const tinygltf::Material& source, MaterialExtensions& x) {
  const Extension anisotropy(source, "KHR_materials_anisotropy"), film(source, "KHR_materials_iridescence");
  x.anisotropy = anisotropy.number("anisotropyStrength", 0.0);
  x.anisotropy_rotation = anisotropy.number("anisotropyRotation", 0.0);
  x.iridescence = film.number("iridescenceFactor", 0.0);
  x.iridescence_ior = film.number("iridescenceIor", 1.3);
  x.thinnest_film = film.number("iridescenceThicknessMinimum", 100.0);
  x.iridescence_thickness = film.number("iridescenceThicknessMaximum", 400.0);
  const Extension through(source, "KHR_materials_diffuse_transmission");
  x.diffuse_transmission = through.number("diffuseTransmissionFactor", 0.0);
  x.diffuse_transmission_color = reflectance_from_rgb(through.color("diffuseTransmissionColorFactor"));
}

}  // namespace

bool has_glass(const tinygltf::Material& source, const Material& material) {
  const bool all_metal =
      material.metallic == 1.0f && source.pbrMetallicRoughness.metallicRoughnessTexture.index < 0;
  return material.transmission > 0.0f && !all_metal;
}

void load_material_extensions(const GltfDocument& document, std::size_t index, Material& material) {
  const tinygltf::Material& source = document.model.materials[index];
  load_coats(source, material.extensions);
  load_surface(source, material.extensions);
  load_dispersion(source, material);
  load_conductor(document, index, material);
  load_glass(document, index, material);
  load_medium(document, index, material);
  if (material.extensions.anisotropy > 0.0f) {
    material.needs_tangents = true;
    material.uv_sets |= 1u;  // the grain follows TEXCOORD_0 where there are no tangents
  }
}

}  // namespace photopic
