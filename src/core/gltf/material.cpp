#include "core/gltf/material.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "core/gltf/material_extensions.h"
#include "core/gltf/texture.h"
#include "error.h"
#include "spectral/rgb_upsampling.h"
#include "spectral/spectrum_file.h"

namespace photopic {
namespace {

std::vector<double> numbers(const tinygltf::Value& list) {
  std::vector<double> values;
  for (std::size_t i = 0; i < list.ArrayLen(); ++i)
    values.push_back(list.Get(static_cast<int>(i)).GetNumberAsDouble());
  return values;
}

void check_reflectance(const GltfDocument& document, const std::string& pointer, const Spectrum& spectrum) {
  const auto check = [&](double lambda) {
    const double value = evaluate(spectrum, lambda);
    if (!(value >= 0.0 && value <= 1.0)) {
      document.fail(pointer,
                    fmt::format("a reflectance of {} at {} nm is not between 0 and 1", value, lambda),
                    "divide percentages by 100");
    }
  };
  for (int lambda = static_cast<int>(kLambdaMin); lambda <= static_cast<int>(kLambdaMax); ++lambda)
    check(lambda);
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum))
    std::ranges::for_each(table->lambda(), check);
}

void set_base_color(const GltfDocument& document, std::size_t index, Material& material) {
  const auto& factor = document.model.materials[index].pbrMetallicRoughness.baseColorFactor;
  material.alpha = static_cast<float>(factor[3]);
  if (const auto given = extras_spectrum(document, index, "reflectance_spectrum", Beyond::end_value)) {
    check_reflectance(document, fmt::format("/materials/{}/extras/reflectance_spectrum", index),
                      given->spectrum);
    material.base_color = given->spectrum;
    material.base_is_measured = true;
  } else {
    material.base_color = reflectance_from_rgb({factor[0], factor[1], factor[2]});
    material.base_factor = to_float({factor[0], factor[1], factor[2]});
  }
}

/// The colour may be above 1, a reflectance may not.
void set_specular_color(const Rgb& color, Material& material) {
  const double scale = std::max({1.0, color.r, color.g, color.b});
  const Rgb scaled{color.r / scale, color.g / scale, color.b / scale};
  material.specular_scale = static_cast<float>(scale);
  material.specular_color = reflectance_from_rgb(scaled);
  material.specular_color_factor = to_float({scaled.r, scaled.g, scaled.b});
}

/// What textures and vertex colours need of the geometry.
void set_attributes(const GltfDocument& document, std::size_t index, Material& material) {
  for (const GltfTextureUse& use : gltf_texture_uses(document, index)) {
    material.uv_sets = static_cast<std::uint8_t>(material.uv_sets | 1u << use.uv_set);
    material.needs_tangents |= use.slot->is_normal_map;
  }
}

AlphaMode alpha_mode(const std::string& name) {
  return name == "MASK" ? AlphaMode::mask : name == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

/// Shown as it is: a lamp of its base colour, seen from both sides, that reflects nothing.
void make_unlit(Material& material) {
  material.unlit = true;
  material.extensions = {};
  material.base_color = ConstantSpectrum{0.0};
  material.metallic = material.specular = material.transmission = 0.0f;
  material.double_sided = true;
}

/// COLOR_0 is a mesh's, but whether a material varies must be known before it is shaded.
void find_vertex_colors(const GltfDocument& document, std::vector<Material>& materials) {
  for (const tinygltf::Mesh& mesh : document.model.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (!primitive.attributes.contains("COLOR_0")) continue;
      const bool given = primitive.material >= 0;
      materials[given ? static_cast<std::size_t>(primitive.material) : materials.size() - 1]
          .has_vertex_colors = true;
    }
}

Material load_material(const GltfDocument& document, std::size_t index) {
  const tinygltf::Material& source = document.model.materials[index];
  const std::string pointer = fmt::format("/materials/{}", index);
  const Extension specular(source, "KHR_materials_specular"), ior(source, "KHR_materials_ior");
  const Extension transmission(source, "KHR_materials_transmission"), volume(source, "KHR_materials_volume");

  Material material;
  material.name = source.name;
  set_base_color(document, index, material);
  set_attributes(document, index, material);
  material.alpha_mode = alpha_mode(source.alphaMode);
  material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
  material.metallic = static_cast<float>(source.pbrMetallicRoughness.metallicFactor);
  material.roughness = static_cast<float>(source.pbrMetallicRoughness.roughnessFactor);
  material.ior = ior.number("ior", 1.5);
  if (material.ior > 0.0f && material.ior < 1.0f)
    document.fail(pointer + "/extensions/KHR_materials_ior/ior",
                  fmt::format("{} is neither 0 nor at least 1", material.ior), "glass is 1.5, water 1.33");
  material.specular = specular.number("specularFactor", 1.0);
  set_specular_color(specular.color("specularColorFactor"), material);
  material.transmission = transmission.number("transmissionFactor", 0.0);
  material.thin_walled = !(volume.number("thicknessFactor", 0.0) > 0.0f);
  material.attenuation_color = reflectance_from_rgb(volume.color("attenuationColor"));
  material.attenuation_distance = volume.number("attenuationDistance", 0.0);
  if (!std::isfinite(material.attenuation_distance)) material.attenuation_distance = 0.0f;
  load_material_extensions(document, index, material);
  material.double_sided = source.doubleSided;
  if (source.extensions.contains("KHR_materials_unlit")) make_unlit(material);
  return material;
}

/// "clearcoat and sheen", or nothing: what the opaque share of a material has and its glass has not.
std::string missing_on_glass(const MaterialExtensions& x) {
  std::vector<std::string> names;
  if (x.clearcoat > 0.0f) names.emplace_back("clearcoat");
  if (x.has_sheen()) names.emplace_back("sheen");
  if (x.anisotropy > 0.0f) names.emplace_back("anisotropy");
  return fmt::format("{}", fmt::join(names, " and "));
}

void warn_of_bare_glass(const GltfDocument& document, Scene& scene) {
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    const std::string missing = missing_on_glass(material.extensions);
    if (missing.empty() || !has_glass(document.model.materials[i], material)) continue;
    scene.warnings.push_back(
        fmt::format("material {}: its glass is rendered without {}", quoted_name(scene, i), missing));
  }
}

/// What diffuse transmission lets in goes straight on to the next surface: there is no subsurface scattering.
bool has_idle_attenuation(const Material& m) {
  const auto* color = std::get_if<ConstantSpectrum>(&m.attenuation_color);
  const bool absorbs = m.attenuation_distance > 0.0f && !m.thin_walled && !(color && color->value == 1.0);
  return absorbs && m.extensions.diffuse_transmission > 0.0f && m.transmission < 1.0f;
}

void warn_of_idle_attenuation(Scene& scene) {
  const auto first = std::ranges::find_if(scene.materials, has_idle_attenuation);
  if (first == scene.materials.end()) return;
  const auto others = std::count_if(first + 1, scene.materials.end(), has_idle_attenuation);
  scene.warnings.push_back(fmt::format(
      "material {}{}: KHR_materials_volume does not attenuate what is diffusely transmitted; give "
      "diffuseTransmissionColorFactor that colour",
      quoted_name(scene, static_cast<std::size_t>(first - scene.materials.begin())),
      others > 0 ? fmt::format(" and {} more", others) : ""));
}

}  // namespace

Spectrum reflectance_from_rgb(const Rgb& color) {
  if (color.r == color.g && color.g == color.b) return ConstantSpectrum{std::clamp(color.r, 0.0, 1.0)};
  return upsample_reflectance(color);
}

std::optional<ExtrasSpectrum> extras_spectrum(const GltfDocument& document, const tinygltf::Value& extras,
                                              const std::string& object, const std::string& owner,
                                              const char* key, Beyond beyond) {
  if (!extras.IsObject() || !extras.Has(key)) return std::nullopt;
  const tinygltf::Value& value = extras.Get(key);
  const std::string pointer = fmt::format("{}/extras/{}", object, key);
  try {
    if (value.IsString()) {
      const auto& text = value.Get<std::string>();
      return ExtrasSpectrum{parse_spectrum(text, document.folder(), beyond), text};
    }
    const TabulatedSpectrum table(numbers(value.Get("nm")), numbers(value.Get("value")), beyond);
    return ExtrasSpectrum{table, owner};
  } catch (const std::invalid_argument& error) {
    document.fail(pointer, error.what(), "correct the spectrum");
  } catch (const InputError& error) {
    if (!value.IsString()) throw;
    throw InputError(document.file.path.string() + "#" + pointer, error.what(),
                     "files are sought beside the glTF file");
  }
}

std::optional<ExtrasSpectrum> extras_spectrum(const GltfDocument& document, std::size_t index,
                                              const char* key, Beyond beyond) {
  const tinygltf::Material& material = document.model.materials[index];
  return extras_spectrum(document, material.extras, fmt::format("/materials/{}", index),
                         "of material " + material.name, key, beyond);
}

std::string quoted_name(const Scene& scene, std::size_t material) {
  const std::string& name = scene.materials[material].name;
  return name.empty() ? std::to_string(material) : fmt::format("\"{}\"", name.substr(0, 60));
}

void load_gltf_materials(const GltfDocument& document, Scene& scene) {
  const std::size_t count = document.model.materials.size();
  scene.materials.reserve(count + 1);
  for (std::size_t i = 0; i < count; ++i) scene.materials.push_back(load_material(document, i));
  scene.materials.push_back(Material{.name = "default"});
  find_vertex_colors(document, scene.materials);
  warn_of_bare_glass(document, scene);
  warn_of_idle_attenuation(scene);
}

}  // namespace photopic
