#include "core/surface.h"

#include "core/bsdf/microfacet.h"

namespace photopic {
namespace {

Vec3f operator*(Vec3f a, Vec4f b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

bool has_texture(const Material& m, Texture MaterialTextures::*which) {
  return m.textures && (*m.textures).*which;
}

bool has_partial_alpha(const Material& m) {
  if (m.alpha_mode == AlphaMode::opaque) return false;
  const bool textured =
      has_texture(m, &MaterialTextures::base_color) && m.textures->base_color.image->has_alpha();
  return textured || m.has_vertex_colors ||
         m.alpha < (m.alpha_mode == AlphaMode::mask ? m.alpha_cutoff : 1.0f);
}

bool may_transmit(const Material& m) {
  return m.transmission > 0.0f &&
         (m.metallic < 1.0f || has_texture(m, &MaterialTextures::metallic_roughness));
}

/// Of index 0 it is a mirror.
bool may_be_pane(const Material& m) {
  return may_transmit(m) && m.thin_walled && m.ior != 0.0f &&
         (sqr(m.roughness) < kSmoothAlpha || has_texture(m, &MaterialTextures::metallic_roughness));
}

/// Of a lamp, as a rule.
bool is_black(const Material& m) {
  if (opaque_kind_of(m) != BsdfKind::diffuse || may_transmit(m) || m.has_vertex_colors) return false;
  if (m.unlit) return true;
  return !has_texture(m, &MaterialTextures::base_color) && !m.base_is_measured && m.base_factor == Vec3f{};
}

BsdfKind glass_kind_of(const Material& m) {
  const auto* specular = std::get_if<ConstantSpectrum>(&m.specular_color);
  const bool colored = specular == nullptr || specular->value != 1.0 || m.specular_scale != 1.0f ||
                       has_texture(m, &MaterialTextures::specular_color);
  return (m.extensions.is_spectral_glass() || colored) && m.ior != 0.0f ? BsdfKind::spectral_glass
                                                                        : BsdfKind::glass;
}

std::shared_ptr<const MaterialExtensions> extensions_of(const Material& m) {
  return m.extensions.any() ? std::make_shared<const MaterialExtensions>(m.extensions) : nullptr;
}

}  // namespace

BsdfKind opaque_kind_of(const Material& m) {
  if (m.extensions.is_layered()) return BsdfKind::layered;
  if (m.extensions.conductor) return BsdfKind::conductor;
  return m.metallic == 0.0f && m.specular == 0.0f ? BsdfKind::diffuse : BsdfKind::opaque;
}

Surface::Surface(const Material& m)
    : opaque_kind(opaque_kind_of(m)),
      glass_kind(glass_kind_of(m)),
      scatters(!is_black(m)),
      transmits(may_transmit(m)),
      emits(m.emission_spectrum >= 0 && m.emission_luminance > 0.0f),
      double_sided(m.double_sided),
      solid(!m.thin_walled),
      encloses(transmits && solid && m.ior != 0.0f),
      lets_through(transmits || m.extensions.diffuse_transmission > 0.0f),
      is_pane(may_be_pane(m)),
      base_varies(!m.unlit && (m.has_vertex_colors || has_texture(m, &MaterialTextures::base_color))),
      emission_varies(has_texture(m, &MaterialTextures::emissive) || m.unlit),
      maps_normals(has_texture(m, &MaterialTextures::normal)),
      coat_has_normals(m.extensions.clearcoat > 0.0f &&
                       (maps_normals || has_texture(m, &MaterialTextures::clearcoat_normal))),
      partly_covers(has_partial_alpha(m)),
      base_color(m.base_color),
      specular_color(m.specular_color),
      base_factor(m.base_factor),
      specular_color_factor(m.specular_color_factor),
      base_is_measured(m.base_is_measured),
      has_vertex_colors(m.has_vertex_colors),
      textures(m.textures),
      alpha_mode(m.alpha_mode),
      alpha(m.alpha),
      alpha_cutoff(m.alpha_cutoff),
      metallic(m.metallic),
      roughness(m.roughness),
      transmission(m.transmission),
      specular(m.specular),
      specular_scale(m.specular_scale),
      ior(m.ior),
      attenuation_color(m.attenuation_color),
      attenuation_distance(m.attenuation_distance),
      priority(m.priority),
      extensions(extensions_of(m)),
      emission_spectrum(m.emission_spectrum),
      emission_luminance(m.emission_luminance),
      emissive_factor(m.emissive_factor),
      emission_is_measured(m.emission_is_measured),
      unlit(m.unlit) {}

Vec3f Surface::base_rgb(const TrianglePoint& point) const {
  Vec3f rgb = base_factor;
  if (textures && textures->base_color) rgb = rgb * point.look_up(textures->base_color);
  if (has_vertex_colors) rgb = rgb * point.color();
  return rgb;
}

Vec3f Surface::emissive_rgb(const TrianglePoint& point) const {
  Vec3f rgb = emissive_factor;
  if (textures && textures->emissive) rgb = rgb * point.look_up(textures->emissive);
  if (unlit && has_vertex_colors) rgb = rgb * point.color();
  return rgb;
}

void Surface::prefetch(const TrianglePoint& point) const {
  if (!textures) return;
  for (const Texture* texture : {&textures->base_color, &textures->metallic_roughness, &textures->normal})
    if (*texture) texture->prefetch(point.uv(texture->uv_set));
}

float Surface::coverage(const TrianglePoint& point) const {
  if (!partly_covers) return 1.0f;
  float a = alpha;
  if (textures && textures->base_color) a *= point.look_up(textures->base_color).w;
  if (has_vertex_colors) a *= point.color().w;
  return alpha_mode == AlphaMode::mask ? (a >= alpha_cutoff ? 1.0f : 0.0f) : std::clamp(a, 0.0f, 1.0f);
}

}  // namespace photopic
