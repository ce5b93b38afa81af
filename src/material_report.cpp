#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/surface.h"
#include "scene_report.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::size_t> material_triangles(const Scene& scene) {
  std::vector<std::size_t> counts(scene.materials.size());
  for (const Shape& shape : scene.geometry.shapes) counts[shape.material] += shape.triangle_count;
  return counts;
}

/// The colour of a reflectance under D65, linear sRGB.
Rgb color_under_d65(const Spectrum& reflectance) {
  if (const auto* grey = std::get_if<ConstantSpectrum>(&reflectance))
    return {grey->value, grey->value, grey->value};
  static const TabulatedSpectrum d65 = tabulate_emission(cie_illuminant("D65").value());
  static const double white = emission_xyz(d65, Observer::cie1931()).y;
  return xyz_to_linear_srgb(emission_xyz(tabulate_product(reflectance, d65), Observer::cie1931()) *
                            (1.0 / white));
}

std::string color_text(const Rgb& color) {
  const auto rounded = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };  // no "-0.000"
  return fmt::format("{:.3f} {:.3f} {:.3f}", rounded(color.r), rounded(color.g), rounded(color.b));
}

std::string kind_of(const Material& m) {
  if (m.unlit) return "unlit";
  if (m.extensions.conductor) return "metal, measured";
  const double glass = m.transmission * (1.0 - m.metallic);
  const std::string clear = m.thin_walled ? "thin glass" : "solid glass";
  if (glass >= 1.0) return clear;
  const Surface surface(m);
  const std::string opaque = surface.opaque_kind == BsdfKind::diffuse ? "diffuse"
                             : m.metallic >= 1.0f                     ? "metal"
                             : m.metallic > 0.0f                      ? "dielectric and metal"
                                                                      : "dielectric";
  return glass > 0.0 ? opaque + " and " + clear : opaque;
}

Json parameters_of(const Material& m) {
  Json json = {{"roughness", m.roughness}};
  const auto add = [&](const char* name, float value, float otherwise) {
    if (value != otherwise) json[name] = value;
  };
  add("metallic", m.metallic, 0.0f);
  add("ior", m.ior, 1.5f);
  add("specular", m.specular, 1.0f);
  add("transmission", m.transmission, 0.0f);
  add("attenuation_distance", m.attenuation_distance, 0.0f);
  add("priority", static_cast<float>(m.priority), 0.0f);
  const MaterialExtensions& x = m.extensions;
  if (x.dispersion && is_dispersive(*x.dispersion)) json["abbe_number"] = abbe_number(*x.dispersion);
  add("clearcoat", x.clearcoat, 0.0f);
  add("anisotropy", x.anisotropy, 0.0f);
  add("iridescence", x.iridescence, 0.0f);
  add("diffuse_transmission", x.diffuse_transmission, 0.0f);
  if (x.has_sheen()) json["sheen_roughness"] = x.sheen_roughness;
  if (m.alpha_mode == AlphaMode::mask) json["alpha_cutoff"] = m.alpha_cutoff;
  if (m.alpha_mode == AlphaMode::blend) json["alpha_blend"] = true;
  if (m.double_sided) json["double_sided"] = true;
  if (m.has_vertex_colors) json["vertex_colors"] = true;
  return json;
}

std::string parameters_text(const Json& parameters) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : parameters.items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    parts.push_back(value.is_boolean() ? words : fmt::format("{} {:.4g}", words, value.get<double>()));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

struct Slot {
  const char* name;
  Texture MaterialTextures::*texture;
};
constexpr Slot kSlots[] = {
    {"base color", &MaterialTextures::base_color},
    {"metallic-roughness", &MaterialTextures::metallic_roughness},
    {"normal", &MaterialTextures::normal},
    {"emissive", &MaterialTextures::emissive},
    {"transmission", &MaterialTextures::transmission},
    {"specular", &MaterialTextures::specular},
    {"specular color", &MaterialTextures::specular_color},
};

/// Calls `visit(slot's name, texture)` for each that the material has.
template <typename Visit>
void for_each_texture(const Material& material, const Visit& visit) {
  if (!material.textures) return;
  for (const Slot& slot : kSlots)
    if (const Texture& texture = (*material.textures).*slot.texture) visit(slot.name, texture);
}

std::vector<std::string> texture_names(const Material& material) {
  std::vector<std::string> names;
  for_each_texture(material, [&](const char* name, const Texture&) { names.emplace_back(name); });
  return names;
}

/// An image and what it is read for, by whichever materials.
struct UsedImage {
  const TextureImage* image;
  std::set<std::string> uses;
  bool srgb = false, linear = false;

  std::string encoding() const { return srgb && linear ? "sRGB and linear" : srgb ? "sRGB" : "linear"; }
  int bits() const { return image->texels.index() == 0 ? 8 : 16; }
  std::size_t bytes() const {
    return std::visit([](const auto& texels) { return texels.size() * sizeof texels[0]; }, image->texels);
  }
};

std::vector<UsedImage> used_images(const Scene& scene) {
  std::vector<UsedImage> images;
  std::map<const TextureImage*, std::size_t> numbers;
  for (const Material& material : scene.materials)
    for_each_texture(material, [&](const char* name, const Texture& texture) {
      const auto [number, is_new] = numbers.emplace(texture.image.get(), images.size());
      if (is_new) images.push_back({texture.image.get(), {}});
      UsedImage& used = images[number->second];
      used.uses.insert(name);
      (texture.srgb ? used.srgb : used.linear) = true;
    });
  return images;
}

}  // namespace

ReportSection report_materials(const Scene& scene) {
  ReportSection section{"materials",
                        "materials",
                        {{"name", "kind", "color (linear sRGB)", "triangles", "parameters", "textures"}},
                        {}};
  section.json = Json::array();
  const std::vector<std::size_t> triangles = material_triangles(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    if (i + 1 == scene.materials.size() && triangles[i] == 0) break;  // glTF's default, not used
    const Vec3f shown = m.base_factor;
    const Rgb color = m.unlit ? Rgb{shown.x, shown.y, shown.z} : color_under_d65(m.base_color);
    const Json parameters = parameters_of(m);
    section.rows.push_back({m.name.empty() ? "(no name)" : m.name, kind_of(m), color_text(color),
                            triangles[i] > 0 ? std::to_string(triangles[i]) : "not used",
                            parameters_text(parameters),
                            fmt::format("{}", fmt::join(texture_names(m), ", "))});
    section.json.push_back({{"name", m.name},
                            {"kind", kind_of(m)},
                            {"color_linear_srgb", {color.r, color.g, color.b}},
                            {"triangles", triangles[i]},
                            {"parameters", parameters},
                            {"textures", texture_names(m)}});
  }
  return section;
}

ReportSection report_textures(const Scene& scene) {
  ReportSection section{
      "textures", "textures", {{"name", "size", "channels", "encoding", "memory", "read for"}}, {}};
  section.json = Json::array();
  for (const UsedImage& used : used_images(scene)) {
    const TextureImage& image = *used.image;
    section.rows.push_back({name_text(image.name), fmt::format("{}x{}", image.width, image.height),
                            fmt::format("{} of {} bits", image.channels, used.bits()), used.encoding(),
                            size_text(static_cast<double>(used.bytes())),
                            fmt::format("{}", fmt::join(used.uses, ", "))});
    section.json.push_back({{"name", image.name},
                            {"resolution", {image.width, image.height}},
                            {"channels", image.channels},
                            {"bits", used.bits()},
                            {"encoding", used.encoding()},
                            {"bytes", used.bytes()},
                            {"read_for", used.uses}});
  }
  return section;
}

}  // namespace photopic
