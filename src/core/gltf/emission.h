#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/gltf/document.h"
#include "core/gltf_loader.h"

namespace photopic {

/// Something of the file that emits light: a material, a light, the environment.
struct GltfEmitter {
  std::string name;               ///< for `--emitter NAME=SPECTRUM`
  std::string kind;               ///< "material" or "light", for messages
  std::string pointer;            ///< JSON pointer of it
  std::string color_member;       ///< member of it that holds the colour
  Rgb color;                      ///< linear sRGB, not black
  const tinygltf::Value* extras;  ///< may hold an emission_spectrum; null: none
  bool is_lamp = true;            ///< else its spectrum is that of its colour, whatever else is said
};

/// Collects a scene's emission spectra: of an override, else of `extras.emission_spectrum`, else the colour
/// upsampled on D65.
class GltfEmissions {
 public:
  GltfEmissions(const GltfDocument& document, std::vector<EmitterOverride> overrides, Scene& scene);

  struct Added {
    int spectrum;   ///< index into Scene::emission_spectra; equal spectra are kept once
    bool measured;  ///< by an override or extras, not by the colour
  };
  /// @throws InputError for spectra without light
  Added add(const GltfEmitter& emitter);

  /// Refuses an object that emits nothing, but names a lamp in its extras: a mistake worth telling.
  void check_dark(const tinygltf::Value& extras, const std::string& pointer, const std::string& remedy) const;

  /// Whether any of those added is a lamp.
  bool has_lamp() const { return has_lamp_; }

  /// @throws InputError for overrides that name none of those added
  void check_overrides() const;

 private:
  const GltfDocument& document_;
  const std::vector<EmitterOverride> overrides_;
  Scene& scene_;
  std::map<std::string, int> index_of_;  ///< of each spectrum, by its digest
  std::set<std::string> names_;          ///< of lamps
  bool has_lamp_ = false;
};

/// Gives the scene's used materials (those of a shape) their emission: emissiveFactor's luminance ×
/// emissiveStrength; none to those whose emissive texture is black all over, as many exporters write it.
/// @throws InputError
void load_gltf_emission(const GltfDocument& document, GltfEmissions& emissions, Scene& scene);

}  // namespace photopic
