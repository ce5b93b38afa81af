#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/affine.h"
#include "core/camera.h"
#include "core/lights/environment.h"
#include "core/lights/punctual_light.h"
#include "core/material_extensions.h"
#include "core/math.h"
#include "core/texture.h"
#include "spectral/spectrum.h"

namespace photopic {

/// What varies over a material; each is multiplied with the material's number or colour of that name.
struct MaterialTextures {
  Texture base_color;          ///< and, in its alpha, the coverage
  Texture metallic_roughness;  ///< blue and green
  Texture normal;              ///< in tangent space, [0, 1] for [−1, 1]
  float normal_scale = 1.0f;   ///< on its x and y
  Texture emissive;
  Texture transmission;  ///< red
  Texture specular;      ///< alpha
  Texture specular_color;
  Texture clearcoat;            ///< red
  Texture clearcoat_roughness;  ///< green
  Texture clearcoat_normal;     ///< as normal
  float clearcoat_normal_scale = 1.0f;
  Texture sheen_color;
  Texture sheen_roughness;        ///< alpha
  Texture anisotropy;             ///< direction in red and green, [0, 1] for [−1, 1]; strength in blue
  Texture iridescence;            ///< red
  Texture iridescence_thickness;  ///< green
  Texture diffuse_transmission;   ///< alpha
  Texture diffuse_transmission_color;
};

/// How alpha (of material × texture × vertex colour) covers the surface: wholly, where it reaches the cutoff,
/// or as the share of rays that it meets.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// glTF's metallic-roughness material with its transmission, volume, ior and specular extensions, as
/// authored.
struct Material {
  std::string name;
  Spectrum base_color = ConstantSpectrum{1.0};  ///< reflectance in [0, 1], where nothing varies it
  /// Where a texture or vertex colours do: linear sRGB, times these; the product is upsampled.
  Vec3f base_factor{1, 1, 1};
  bool base_is_measured = false;   ///< base_color was given as a spectrum: it varies by their luminance alone
  bool has_vertex_colors = false;  ///< some mesh has COLOR_0 with this material
  std::shared_ptr<const MaterialTextures> textures{};  ///< none in most scenes
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha = 1.0f, alpha_cutoff = 0.5f;
  float metallic = 1.0f;
  float roughness = 1.0f;  ///< perceptual; GGX α = roughness²
  float ior = 1.5f;        ///< 0 (Fresnel 1) or ≥ 1
  float specular = 1.0f;   ///< KHR_materials_specular's specularFactor
  Spectrum specular_color = ConstantSpectrum{1.0};
  Vec3f specular_color_factor{1, 1, 1};  ///< the same as linear sRGB, for a texture
  float specular_scale = 1.0f;           ///< ≥ 1, on either: the colour's product with F0 alone ends at 1
  float transmission = 0.0f;
  bool thin_walled = true;                             ///< thicknessFactor 0: refraction is not seen
  Spectrum attenuation_color = ConstantSpectrum{1.0};  ///< transmittance over attenuation_distance
  float attenuation_distance = 0.0f;                   ///< [m]; 0: no absorption
  int priority = 0;  ///< where solid glasses overlap the highest is there; among equals the last entered
  MaterialExtensions extensions = {};
  bool double_sided = false;  ///< single-sided surfaces emit from their front only

  std::uint8_t uv_sets = 0;  ///< bit i: a texture of it reads TEXCOORD_i; the geometry stores no other
  /// It has a normal map, or is anisotropic: TANGENT is stored if the file has it.
  bool needs_tangents = false;

  int emission_spectrum = -1;       ///< index into Scene::emission_spectra, −1: emits nothing
  float emission_luminance = 0.0f;  ///< factor on that spectrum, which has unit luminance [cd/m²]
  /// Of what is textured or unlit a further factor: linear sRGB in [0, 1], times texture; upsampled.
  Vec3f emissive_factor{1, 1, 1};
  bool emission_is_measured = false;  ///< the spectrum was given: of that factor only the luminance counts
  /// KHR_materials_unlit: a lamp in its base colour (vertex colours too) that reflects nothing.
  bool unlit = false;
};

/// A range of triangles that share a material.
struct Shape {
  std::uint32_t first_triangle = 0, triangle_count = 0;
  std::uint32_t material = 0;
};

inline constexpr int kUvSets = 4;

/// A mesh that instances share: a range of shapes, relative to the middle of its bounding box [m].
struct Prototype {
  std::uint32_t first_shape = 0, shape_count = 0;
};

/// A prototype somewhere in the world.
struct Instance {
  Affinef to_world;  ///< relative to Scene::origin; invertible, scales by 1e-4 … 1e6
  std::uint32_t prototype = 0;
  float error = 0;  ///< bound on what rounding does to a point of it and to a ray that meets it [m]
};

/// Triangles in world space, relative to Scene::origin [m]; those of prototypes in the prototype's own space.
struct Geometry {
  std::vector<Vec3f> positions;
  /// Indices into positions; counter-clockwise seen from the front.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Cover the triangles in order; those of prototypes stand last, and do not emit.
  std::vector<Shape> shapes;

  std::vector<Prototype> prototypes;  ///< empty in most scenes
  std::vector<Instance> instances;

  /// Shapes that stand in the world by themselves.
  std::size_t baked_shape_count() const {
    return prototypes.empty() ? shapes.size() : prototypes.front().first_shape;
  }

  // Per vertex; each is as long as positions, or empty where no surface of the scene needs it.
  std::vector<Vec3f> normals;                   ///< unit shading normals, zero where the surface is flat
  std::vector<Vec4f> tangents;                  ///< unit, w the bitangent's sign; zero where not given
  std::array<std::vector<Vec2f>, kUvSets> uvs;  ///< TEXCOORD_0 … 3; zero where not given
  std::vector<Vec4f> colors;                    ///< COLOR_0, linear RGBA, a factor on the base colour; else 1
};

/// Everything a render needs to know, without acceleration structures.
struct Scene {
  Geometry geometry;
  std::vector<Material> materials;
  std::vector<TabulatedSpectrum> emission_spectra;  ///< distinct; each with ∫ȳI dλ / ∫ȳ dλ = 1
  std::vector<std::string> emission_names;          ///< of each spectrum, as the user called it
  std::vector<PunctualLight> punctual_lights;
  std::shared_ptr<const Environment> environment;  ///< none: paths that leave the scene end in the dark
  Camera camera;
  int scene_index = -1;    ///< in the file's list; −1: it has none
  std::string scene_name;  ///< as options would choose it: its name, else "index:N"; empty: the file has none
  std::string camera_name;  ///< of the camera, else of its node
  int camera_index = -1;    ///< in the file's list; −1: in none, it frames the scene
  Vec3d origin;             ///< world position of the coordinates' zero: floats stay accurate far from 0
  std::vector<std::string> warnings;         ///< one line each: what was ignored or mended
  std::vector<std::filesystem::path> files;  ///< that the scene's file names; some may not exist
};

}  // namespace photopic
