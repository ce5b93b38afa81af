#include "core/gltf/texture.h"

#include <fmt/format.h>

#include <set>

#include "core/gltf/image.h"

namespace photopic {
namespace {

/// A textureInfo object, whether tinygltf knows its place or keeps it as an extension's value.
struct Info {
  int index = -1, tex_coord = 0;
  const tinygltf::Value* transform = nullptr;  ///< KHR_texture_transform

  template <typename T>
  static Info of(const T& known) {
    const auto found = known.extensions.find("KHR_texture_transform");
    return {known.index, known.texCoord, found == known.extensions.end() ? nullptr : &found->second};
  }
  static Info of_value(const tinygltf::Value& value) {
    Info info{integer(value, "index", -1), integer(value, "texCoord", 0), nullptr};
    if (value.Has("extensions") && value.Get("extensions").Has("KHR_texture_transform"))
      info.transform = &value.Get("extensions").Get("KHR_texture_transform");
    return info;
  }
  static int integer(const tinygltf::Value& value, const char* key, int otherwise) {
    return value.Has(key) && value.Get(key).IsNumber() ? value.Get(key).GetNumberAsInt() : otherwise;
  }
};

/// Translation · rotation · scale; a positive rotation turns the coordinates counter-clockwise as the image
/// is seen, v pointing down.
UvTransform uv_transform(const tinygltf::Value* value) {
  if (!value) return {};
  const auto number = [&](const char* key, int i, double otherwise) {
    if (!value->Has(key)) return otherwise;
    const tinygltf::Value& member = value->Get(key);
    return member.IsArray() ? member.Get(i).GetNumberAsDouble() : member.GetNumberAsDouble();
  };
  const double c = std::cos(number("rotation", 0, 0.0)), s = std::sin(number("rotation", 0, 0.0));
  const double x = number("scale", 0, 1.0), y = number("scale", 1, 1.0);
  return {to_float({c * x, s * y, number("offset", 0, 0.0)}),
          to_float({-s * x, c * y, number("offset", 1, 0.0)})};
}

/// Where tinygltf keeps a slot's textureInfo object.
Info info_of(const tinygltf::Material& m, const TextureSlot& slot) {
  using M = MaterialTextures;
  if (slot.texture == &M::base_color) return Info::of(m.pbrMetallicRoughness.baseColorTexture);
  if (slot.texture == &M::metallic_roughness)
    return Info::of(m.pbrMetallicRoughness.metallicRoughnessTexture);
  if (slot.texture == &M::normal) return Info::of(m.normalTexture);
  if (slot.texture == &M::emissive) return Info::of(m.emissiveTexture);
  const auto extension = m.extensions.find(slot.extension);
  if (extension == m.extensions.end() || !extension->second.Has(slot.key)) return {};
  return Info::of_value(extension->second.Get(slot.key));
}

int image_of(const GltfDocument& document, int texture) {
  const tinygltf::Texture& source = document.model.textures[static_cast<std::size_t>(texture)];
  if (source.source >= 0) return source.source;
  const std::string pointer = fmt::format("/textures/{}", texture);
  for (const char* extension :
       {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"})
    if (source.extensions.contains(extension))
      document.fail(pointer, fmt::format("it has no image but that of {}, which cannot be read", extension),
                    "export PNG or JPEG images");
  document.fail(pointer, "it names no image", "give it a \"source\"");
}

Wrap wrap_of(int code) {
  if (code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  return code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

float clearcoat_normal_scale(const tinygltf::Material& source) {
  const auto clearcoat = source.extensions.find("KHR_materials_clearcoat");
  if (clearcoat == source.extensions.end() || !clearcoat->second.Has("clearcoatNormalTexture")) return 1.0f;
  const tinygltf::Value& info = clearcoat->second.Get("clearcoatNormalTexture");
  return info.Has("scale") ? static_cast<float>(info.Get("scale").GetNumberAsDouble()) : 1.0f;
}

Texture make_texture(const GltfDocument& document, const GltfTextureUse& use,
                     std::shared_ptr<const TextureImage> image) {
  Texture texture{
      .image = std::move(image), .uv_set = use.uv_set, .transform = use.transform, .srgb = use.slot->srgb};
  const int index = document.model.textures[static_cast<std::size_t>(use.texture)].sampler;
  if (index < 0) return texture;
  const tinygltf::Sampler& sampler = document.model.samplers[static_cast<std::size_t>(index)];
  texture.wrap_u = wrap_of(sampler.wrapS);
  texture.wrap_v = wrap_of(sampler.wrapT);
  texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  return texture;
}

}  // namespace

std::vector<GltfTextureUse> gltf_texture_uses(const GltfDocument& document, std::size_t material) {
  const tinygltf::Material& m = document.model.materials[material];
  const bool unlit = m.extensions.contains("KHR_materials_unlit");
  std::vector<GltfTextureUse> uses;
  for (const TextureSlot& slot : kTextureSlots) {
    const bool is_base = slot.texture == &MaterialTextures::base_color;
    if (unlit && !is_base && slot.texture != &MaterialTextures::emissive) continue;
    const Info info = unlit ? Info::of(m.pbrMetallicRoughness.baseColorTexture) : info_of(m, slot);
    if (info.index < 0) continue;
    const int set =
        info.transform ? Info::integer(*info.transform, "texCoord", info.tex_coord) : info.tex_coord;
    uses.push_back({&slot, info.index, static_cast<std::uint8_t>(set), uv_transform(info.transform)});
  }
  return uses;
}

void load_gltf_textures(const GltfDocument& document, Scene& scene) {
  std::set<std::size_t> used_materials;
  for (const Shape& shape : scene.geometry.shapes)
    if (shape.material < document.model.materials.size()) used_materials.insert(shape.material);

  std::set<int> used_images;
  for (const std::size_t material : used_materials)
    for (const GltfTextureUse& use : gltf_texture_uses(document, material))
      used_images.insert(image_of(document, use.texture));
  const auto images = decode_gltf_images(document, used_images);

  for (const std::size_t material : used_materials) {
    const auto uses = gltf_texture_uses(document, material);
    if (uses.empty()) continue;
    auto textures = std::make_shared<MaterialTextures>();
    for (const GltfTextureUse& use : uses) {
      const auto image = static_cast<std::size_t>(image_of(document, use.texture));
      (*textures).*use.slot->texture = make_texture(document, use, images[image]);
    }
    const tinygltf::Material& source = document.model.materials[material];
    textures->normal_scale = static_cast<float>(source.normalTexture.scale);
    textures->clearcoat_normal_scale = clearcoat_normal_scale(source);
    scene.materials[material].textures = std::move(textures);
  }
}

}  // namespace photopic
