#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/math.h"
#include "spectral/spectrum.h"

namespace photopic {

/// glTF's metallic-roughness material with its transmission, volume, ior and specular extensions, as
/// authored.
struct Material {
  std::string name;
  Spectrum base_color = ConstantSpectrum{1.0};  ///< reflectance in [0, 1]
  float metallic = 1.0f;
  float roughness = 1.0f;  ///< perceptual; GGX α = roughness²
  float ior = 1.5f;        ///< 0 (Fresnel 1) or ≥ 1
  float specular = 1.0f;   ///< KHR_materials_specular's specularFactor
  Spectrum specular_color = ConstantSpectrum{1.0};
  float transmission = 0.0f;
  bool thin_walled = true;                             ///< thicknessFactor 0: refraction is not seen
  Spectrum attenuation_color = ConstantSpectrum{1.0};  ///< transmittance over attenuation_distance
  float attenuation_distance = 0.0f;                   ///< [m]; 0: no absorption
  bool double_sided = false;                           ///< single-sided surfaces emit from their front only

  int emission_spectrum = -1;       ///< index into Scene::emission_spectra, −1: emits nothing
  float emission_luminance = 0.0f;  ///< factor on that spectrum, which has unit luminance [cd/m²]
};

/// A range of triangles that share a material: one glTF primitive under one node.
struct Shape {
  std::uint32_t first_triangle = 0, triangle_count = 0;
  std::uint32_t material = 0;
};

/// Triangles in world space, relative to Scene::origin [m].
struct Geometry {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;  ///< as many as positions: unit shading normals, zero where the surface is flat
  std::vector<std::array<std::uint32_t, 3>>
      triangles;              ///< indices into positions; counter-clockwise seen from the front
  std::vector<Shape> shapes;  ///< cover the triangles in order
};

/// Everything a render needs to know, without acceleration structures.
struct Scene {
  Geometry geometry;
  std::vector<Material> materials;
  std::vector<TabulatedSpectrum> emission_spectra;  ///< distinct; each with ∫ȳI dλ / ∫ȳ dλ = 1
  std::vector<std::string> emission_names;          ///< of each spectrum, as the user called it
  Camera camera;
  Vec3d origin;  ///< world position of the coordinates' zero: floats stay accurate far from 0
  std::vector<std::string> warnings;  ///< one line each: what was ignored or mended
};

}  // namespace photopic
