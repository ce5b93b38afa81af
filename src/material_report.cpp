#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/surface.h"
#include "core/texture_slots.h"
#include "scene_report.h"
#include "spectral/reflectance_color.h"

namespace photopic {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::size_t> material_triangles(const Scene& scene) {
  std::vector<std::size_t> counts(scene.materials.size());
  for (const Shape& shape : scene.geometry.shapes) counts[shape.material] += shape.triangle_count;
  return counts;
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
  const std::string opaque = opaque_kind_of(m) == BsdfKind::diffuse ? "diffuse"
                             : m.metallic >= 1.0f                   ? "metal"
                             : m.metallic > 0.0f                    ? "dielectric and metal"
                                                                    : "dielectric";
  return glass > 0.0 ? opaque + " and " + clear : opaque;
}

/// Collects what is not as by default.
class Parameters {
 public:
  void add(const char* name, float value, float otherwise = 0.0f) {
    if (value != otherwise) json[name] = value;
  }
  void add(const char* name, bool value) {
    if (value) json[name] = true;
  }
  void add_color(const char* name, const Spectrum& reflectance, double scale = 1.0) {
    const auto* grey = std::get_if<ConstantSpectrum>(&reflectance);
    if (grey && grey->value * scale == 1.0) return;
    const Rgb color = color_under_d65(reflectance);
    json[name] = {color.r * scale, color.g * scale, color.b * scale};
  }
  Json json;
};

void add_layers(const Material& m, Parameters& p) {
  const MaterialExtensions& x = m.extensions;
  p.add("clearcoat", x.clearcoat);
  if (x.clearcoat > 0.0f) p.json["clearcoat_roughness"] = x.clearcoat_roughness;
  if (x.has_sheen()) {
    p.add_color("sheen_color", x.sheen_color);
    p.json["sheen_roughness"] = x.sheen_roughness;
  }
  p.add("anisotropy", x.anisotropy);
  if (x.anisotropy > 0.0f) p.add("anisotropy_rotation", x.anisotropy_rotation);
  p.add("iridescence", x.iridescence);
  if (x.iridescence > 0.0f) {
    p.json["iridescence_ior"] = x.iridescence_ior;
    p.json["iridescence_thickness_nm"] = x.iridescence_thickness;
    if (m.textures && m.textures->iridescence_thickness) p.json["thinnest_film_nm"] = x.thinnest_film;
  }
  p.add("diffuse_transmission", x.diffuse_transmission);
  if (x.diffuse_transmission > 0.0f) p.add_color("diffuse_transmission_color", x.diffuse_transmission_color);
}

Json parameters_of(const Material& m) {
  Parameters p;
  p.json["roughness"] = m.roughness;
  p.add("metallic", m.metallic);
  p.add("ior", m.ior, 1.5f);
  p.add("specular", m.specular, 1.0f);
  p.add_color("specular_color", m.specular_color, m.specular_scale);
  p.add("transmission", m.transmission);
  p.add("attenuation_distance", m.attenuation_distance);
  if (m.attenuation_distance > 0.0f) p.add_color("attenuation_color", m.attenuation_color);
  p.add("priority", static_cast<float>(m.priority));
  if (const auto& index = m.extensions.dispersion; index && is_dispersive(*index))
    p.json["abbe_number"] = abbe_number(*index);
  add_layers(m, p);
  if (m.alpha_mode == AlphaMode::mask) p.json["alpha_cutoff"] = m.alpha_cutoff;
  p.add("alpha_blend", m.alpha_mode == AlphaMode::blend);
  p.add("double_sided", m.double_sided);
  p.add("vertex_colors", m.has_vertex_colors);
  return p.json;
}

/// Of a number, a colour, or what is so or not.
std::string value_text(const Json& value) {
  if (value.is_boolean()) return "";
  if (value.is_number()) return fmt::format(" {:.4g}", value.get<double>());
  return " " + color_text({value[0], value[1], value[2]});
}

std::string parameters_text(const Json& parameters) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : parameters.items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    parts.push_back(words + value_text(value));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Calls `visit(slot's name, texture)` for each that the material has.
template <typename Visit>
void for_each_texture(const Material& material, const Visit& visit) {
  if (!material.textures) return;
  for (const TextureSlot& slot : kTextureSlots)
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
