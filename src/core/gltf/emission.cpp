#include "core/gltf/emission.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/gltf/material.h"
#include "error.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"
#include "spectral/spectrum_file.h"

namespace photopic {
namespace {

struct NamedEmission {
  TabulatedSpectrum spectrum;  ///< of unit luminance
  std::string name;
};

TabulatedSpectrum unit_luminance(const Spectrum& spectrum, const std::string& where) {
  try {
    const TabulatedSpectrum emission = tabulate_emission(spectrum);
    const double luminance = emission_xyz(emission, Observer::cie1931()).y;
    if (luminance > 0.0 && std::isfinite(luminance)) return emission.scaled(1.0 / luminance);
  } catch (const std::invalid_argument& error) {
    throw InputError(where, error.what(), "an emission has no negative values");
  }
  throw InputError(where, "the spectrum has no light between 360 and 830 nm that the eye can see",
                   "choose another spectrum");
}

bool is_unlit(const tinygltf::Material& material) {
  return material.extensions.contains("KHR_materials_unlit");
}

/// An unlit surface emits its base colour.
Rgb emissive_factor(const tinygltf::Material& material) {
  const auto& factor =
      is_unlit(material) ? material.pbrMetallicRoughness.baseColorFactor : material.emissiveFactor;
  if (factor.size() < 3) return {};
  return {factor[0], factor[1], factor[2]};
}

/// Of white [cd/m²].
double emissive_strength(const tinygltf::Material& material) {
  const auto extension = material.extensions.find("KHR_materials_emissive_strength");
  const bool given = extension != material.extensions.end() && extension->second.Has("emissiveStrength");
  return given && !is_unlit(material) ? extension->second.Get("emissiveStrength").GetNumberAsDouble() : 1.0;
}

/// [cd/m²], before textures
double emitted_luminance(const tinygltf::Material& material) {
  return linear_srgb_to_xyz(emissive_factor(material)).y * emissive_strength(material);
}

NamedEmission emission_from_rgb(const Rgb& color, const std::string& where) {
  const TabulatedSpectrum d65 = cie_illuminant("D65").value();
  if (color.r == color.g && color.g == color.b) return {unit_luminance(d65, where), "cie:D65"};
  const double top = std::max({color.r, color.g, color.b});
  const Spectrum tint = reflectance_from_rgb({color.r / top, color.g / top, color.b / top});
  return {unit_luminance(tabulate_product(tint, d65), where),
          fmt::format("rgb {:.3g} {:.3g} {:.3g} on cie:D65", color.r, color.g, color.b)};
}

/// The last override of this name, else the last for all.
const EmitterOverride* find_override(const std::vector<EmitterOverride>& overrides, const std::string& name) {
  const EmitterOverride* found = nullptr;
  for (const EmitterOverride& candidate : overrides) {
    const bool weaker = candidate.name.empty() && found && !found->name.empty();
    if ((candidate.name.empty() || candidate.name == name) && !weaker) found = &candidate;
  }
  return found;
}

/// What an override or `extras` say.
std::optional<NamedEmission> given_emission(const GltfDocument& document, std::size_t index,
                                            const std::vector<EmitterOverride>& overrides) {
  const tinygltf::Material& material = document.model.materials[index];
  if (is_unlit(material)) return std::nullopt;
  if (const EmitterOverride* given = find_override(overrides, material.name)) {
    return NamedEmission{
        unit_luminance(parse_spectrum(given->text, {}, Beyond::zero), "--emitter " + given->text),
        given->text};
  }
  if (const auto given = extras_spectrum(document, index, "emission_spectrum", Beyond::zero)) {
    const std::string where =
        fmt::format("{}#/materials/{}/extras/emission_spectrum", document.file.path.string(), index);
    return NamedEmission{unit_luminance(given->spectrum, where), given->name};
  }
  return std::nullopt;
}

/// Where a texture tints the emission, the material's colour does so with it, on white.
NamedEmission set_emission(const GltfDocument& document, std::size_t index,
                           const std::vector<EmitterOverride>& overrides, Material& material) {
  const tinygltf::Material& source = document.model.materials[index];
  const Rgb factor = emissive_factor(source);
  const bool varies =
      (material.textures && material.textures->emissive) || (material.unlit && material.has_vertex_colors);
  material.emissive_factor = to_float({factor.r, factor.g, factor.b});
  material.emission_luminance =
      static_cast<float>(varies ? emissive_strength(source) : emitted_luminance(source));
  if (auto given = given_emission(document, index, overrides)) {
    material.emission_is_measured = true;
    return std::move(*given);
  }
  const std::string where =
      fmt::format("{}#/materials/{}/emissiveFactor", document.file.path.string(), index);
  return emission_from_rgb(varies ? Rgb{1, 1, 1} : factor, where);
}

/// The spectrum's index; equal ones are kept once.
int add_emission(NamedEmission emission, std::vector<std::string>& digests, Scene& scene) {
  const std::string key = digest(emission.spectrum);
  const auto found = std::ranges::find(digests, key);
  const auto index = static_cast<int>(found - digests.begin());
  if (found != digests.end()) return index;
  digests.push_back(key);
  scene.emission_spectra.push_back(std::move(emission.spectrum));
  scene.emission_names.push_back(std::move(emission.name));
  return index;
}

/// Used materials that emit, in the file's order. One that names a lamp but is black is a mistake worth
/// telling.
std::vector<std::size_t> list_emitters(const GltfDocument& document, const Scene& scene) {
  std::set<std::size_t> used;
  for (const Shape& shape : scene.geometry.shapes) used.insert(shape.material);
  std::vector<std::size_t> emitters;
  for (const std::size_t index : used) {
    if (index >= document.model.materials.size()) continue;
    const tinygltf::Material& material = document.model.materials[index];
    if (emitted_luminance(material) > 0.0) {
      emitters.push_back(index);
    } else if (material.extras.IsObject() && material.extras.Has("emission_spectrum")) {
      document.fail(fmt::format("/materials/{}", index), "it has an emission_spectrum but emits nothing",
                    "set emissiveFactor and emissiveStrength to its luminance");
    }
  }
  return emitters;
}

void check_overrides(const GltfDocument& document, const std::vector<EmitterOverride>& overrides,
                     const std::vector<std::size_t>& emitters) {
  std::vector<std::size_t> lamps = emitters;
  std::erase_if(lamps, [&](std::size_t index) { return is_unlit(document.model.materials[index]); });
  std::string names;
  for (const std::size_t index : lamps)
    names += (names.empty() ? "\"" : ", \"") + document.model.materials[index].name + "\"";
  for (const EmitterOverride& given : overrides) {
    const auto matches = [&](std::size_t index) {
      return document.model.materials[index].name == given.name;
    };
    if (given.name.empty() || std::ranges::any_of(lamps, matches)) continue;
    throw InputError(
        "--emitter " + given.name + "=" + given.text, "no emissive material has that name",
        names.empty() ? document.file.path.string() + " has no emissive material" : "choose one of " + names);
  }
}

}  // namespace

void load_gltf_emission(const GltfDocument& document, const std::vector<EmitterOverride>& overrides,
                        Scene& scene) {
  const std::vector<std::size_t> emitters = list_emitters(document, scene);
  check_overrides(document, overrides, emitters);
  std::vector<std::string> digests;
  for (const std::size_t index : emitters) {
    Material& material = scene.materials[index];
    material.emission_spectrum =
        add_emission(set_emission(document, index, overrides, material), digests, scene);
  }
}

}  // namespace photopic
