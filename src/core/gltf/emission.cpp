#include "core/gltf/emission.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/gltf/material.h"
#include "core/gltf/name_choice.h"
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
    const double y = luminance(emission);
    if (y > 0.0 && std::isfinite(y)) return emission.scaled(1.0 / y);
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

bool has_emitter_called(const GltfDocument& document, const std::string& name) {
  const auto is_called_so = [&](const auto& object) { return object.name == name; };
  return name == "environment" || std::ranges::any_of(document.model.materials, is_called_so) ||
         std::ranges::any_of(document.model.lights, is_called_so);
}

/// Of "a=b=cie:A" the longest name that the file knows; the shortest where it knows none.
std::vector<EmitterOverride> find_names(const GltfDocument& document,
                                        std::vector<EmitterOverride> overrides) {
  for (EmitterOverride& given : overrides) {
    if (given.name.empty()) continue;
    const std::string text = given.name + "=" + given.text;
    for (std::size_t at = text.rfind('='); at > given.name.size(); at = text.rfind('=', at - 1)) {
      if (!has_emitter_called(document, text.substr(0, at))) continue;
      given = {text.substr(0, at), text.substr(at + 1)};
      break;
    }
  }
  return overrides;
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
std::optional<NamedEmission> given_emission(const GltfDocument& document, const GltfEmitter& emitter,
                                            const std::vector<EmitterOverride>& overrides) {
  if (!emitter.is_lamp) return std::nullopt;
  if (const EmitterOverride* given = find_override(overrides, emitter.name)) {
    return NamedEmission{
        unit_luminance(parse_spectrum(given->text, {}, Beyond::zero), "--emitter " + given->text),
        given->text};
  }
  if (!emitter.extras) return std::nullopt;
  const std::string owner = fmt::format("of {} {}", emitter.kind, emitter.name);
  const auto given =
      extras_spectrum(document, *emitter.extras, emitter.pointer, owner, "emission_spectrum", Beyond::zero);
  if (!given) return std::nullopt;
  const std::string where = document.file.path.string() + "#" + emitter.pointer + "/extras/emission_spectrum";
  return NamedEmission{unit_luminance(given->spectrum, where), given->name};
}

/// Where a texture tints the emission, the material's colour does so with it, on white; so it does where
/// there may be many: scenes drawn in unlit colours shall not have a spectrum for each.
void set_emission(const tinygltf::Material& source, const std::string& pointer, GltfEmissions& emissions,
                  Material& material) {
  const Rgb factor = emissive_factor(source);
  const bool varies = (material.textures && material.textures->emissive) || material.unlit;
  const double top = std::max({factor.r, factor.g, factor.b, 1.0});  // tints end at 1
  material.emissive_factor = to_float({factor.r / top, factor.g / top, factor.b / top});
  material.emission_luminance =
      static_cast<float>(varies ? emissive_strength(source) * top : emitted_luminance(source));
  const GltfEmissions::Added added = emissions.add({.name = source.name,
                                                    .kind = "material",
                                                    .pointer = pointer,
                                                    .color_member = "emissiveFactor",
                                                    .color = varies ? Rgb{1, 1, 1} : factor,
                                                    .extras = &source.extras,
                                                    .is_lamp = !is_unlit(source)});
  material.emission_spectrum = added.spectrum;
  material.emission_is_measured = added.measured;
}

}  // namespace

GltfEmissions::GltfEmissions(const GltfDocument& document, std::vector<EmitterOverride> overrides,
                             Scene& scene)
    : document_(document), overrides_(find_names(document, std::move(overrides))), scene_(scene) {}

GltfEmissions::Added GltfEmissions::add(const GltfEmitter& emitter) {
  std::optional<NamedEmission> given = given_emission(document_, emitter, overrides_);
  const bool measured = given.has_value();
  if (!given)
    given = emission_from_rgb(
        emitter.color, document_.file.path.string() + "#" + emitter.pointer + "/" + emitter.color_member);
  has_lamp_ |= emitter.is_lamp;
  if (emitter.is_lamp && !emitter.name.empty()) names_.insert(emitter.name);
  const auto next = static_cast<int>(scene_.emission_spectra.size());
  const auto [found, is_new] = index_of_.try_emplace(digest(given->spectrum), next);
  if (is_new) {
    scene_.emission_spectra.push_back(std::move(given->spectrum));
    scene_.emission_names.push_back(std::move(given->name));
  }
  return {found->second, measured};
}

void GltfEmissions::check_dark(const tinygltf::Value& extras, const std::string& pointer,
                               const std::string& remedy) const {
  if (extras.IsObject() && extras.Has("emission_spectrum"))
    document_.fail(pointer, "it has an emission_spectrum but emits nothing", remedy);
}

void GltfEmissions::check_overrides() const {
  for (const EmitterOverride& given : overrides_) {
    if (given.name.empty() || names_.contains(given.name)) continue;
    throw InputError(
        "--emitter " + given.name + "=" + given.text, "no emissive material or light has that name",
        names_.empty() ? document_.file.path.string() + " has no emitter with a name: leave NAME= out"
                       : choose_one_of(std::vector(names_.begin(), names_.end()), given.name));
  }
}

void load_gltf_emission(const GltfDocument& document, GltfEmissions& emissions, Scene& scene) {
  std::set<std::size_t> used;
  for (const Shape& shape : scene.geometry.shapes) used.insert(shape.material);
  for (const std::size_t index : used) {
    if (index >= document.model.materials.size()) continue;
    const tinygltf::Material& source = document.model.materials[index];
    const std::string pointer = fmt::format("/materials/{}", index);
    if (!(emitted_luminance(source) > 0.0)) {
      emissions.check_dark(source.extras, pointer,
                           "set emissiveFactor and emissiveStrength to its luminance");
      continue;
    }
    Material& material = scene.materials[index];
    if (material.textures && material.textures->emissive && material.textures->emissive.image->is_black())
      continue;
    set_emission(source, pointer, emissions, material);
  }
}

}  // namespace photopic
