#include "core/bsdf/shading_material.h"
#include "core/prepared_scene.h"
#include "gltf_fixture.h"
#include "support/png.h"

namespace photopic {
namespace {

using test::make_png;
using test::PngColor;

std::string data_uri(const std::string& png) {
  return "data:image/png;base64," + base64(png);
}

/// The square with images 0, 1, … one texel each and a texture for each.
class GltfTextures : public GltfTest {
 protected:
  SquareFile file(const std::string& material, const std::vector<std::string>& uris) const {
    SquareFile f;
    f.materials = "[" + material + "]";
    f.primitive += R"(, "material": 0)";
    std::string images, textures;
    for (std::size_t i = 0; i < uris.size(); ++i) {
      images += fmt::format(R"({}{{"uri": "{}"}})", i ? ", " : "", uris[i]);
      textures += fmt::format(R"({}{{"source": {}}})", i ? ", " : "", i);
    }
    f.more = fmt::format(R"(, "images": [{}], "textures": [{}])", images, textures);
    return f;
  }

  static std::string texel(int r, int g, int b, int a = 255) {
    return data_uri(make_png(1, 1, PngColor::rgba, {r, g, b, a}));
  }
};

constexpr const char* kBase = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";

/// A factor above 1 (of files older than KHR_materials_emissive_strength) is not cut by the texture's
/// colours; a texture that is black all over is no lamp.
TEST_F(GltfTextures, EmissiveFactors) {
  const char* material = R"({"emissiveFactor": [5, 2, 0], "emissiveTexture": {"index": 0}})";
  const Material m = load(file(material, {texel(255, 255, 255)}).str()).materials[0];
  EXPECT_FLOAT_EQ(m.emission_luminance * m.emissive_factor.x, 5.0f);
  EXPECT_FLOAT_EQ(m.emission_luminance * m.emissive_factor.y, 2.0f);
  EXPECT_LE(m.emissive_factor.x, 1.0f);
  EXPECT_LT(load(file(material, {texel(0, 0, 0)}).str()).materials[0].emission_spectrum, 0);
}

TEST_F(GltfTextures, EveryParameterReadsItsChannel) {
  const Scene scene = load(file(R"({
    "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1], "metallicFactor": 0.5, "roughnessFactor": 0.8,
      "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
    "extensions": {
      "KHR_materials_transmission": {"transmissionFactor": 0.9, "transmissionTexture": {"index": 2}},
      "KHR_materials_specular": {"specularFactor": 0.6, "specularTexture": {"index": 3},
        "specularColorFactor": [2, 1, 2], "specularColorTexture": {"index": 4}}}})",
                                {texel(255, 255, 255), texel(9, 102, 51), texel(153, 9, 9),
                                 texel(9, 9, 9, 204), texel(255, 255, 255)})
                               .str());
  const Surface surface(scene.materials[0]);
  SampledSpectrum<4> lambda;
  for (int j = 0; j < 4; ++j) lambda.set(j, 450.0f + 50.0f * static_cast<float>(j));
  const ShadingMaterial<4> m(surface, lambda);
  const float metallic = 0.5f * 0.2f, transmission = 0.9f * 0.6f;
  EXPECT_NEAR(m.roughness(), 0.8f * 0.4f, 1e-6f);
  EXPECT_NEAR(m.glass_probability(), transmission * (1 - metallic), 1e-6f);
  EXPECT_NEAR(m.opaque_metallic(), metallic / (1 - transmission * (1 - metallic)), 1e-6f);
  EXPECT_NEAR(m.specular(), 0.6f * 0.8f, 1e-6f);
  const SigmoidPolynomial base = tabulated_reflectance(0.5f, 1, 1),
                          specular = tabulated_reflectance(1, 0.5f, 1);
  for (int j = 0; j < 4; ++j) {
    EXPECT_NEAR(m.base_color()[j], base(lambda[j]), 1e-6f);
    EXPECT_NEAR(m.specular_color()[j], 2 * specular(lambda[j]), 2e-6f);
  }
}

TEST_F(GltfTextures, EveryExtensionReadsItsChannel) {
  const Scene scene =
      load(file(R"({"extensions": {
    "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatTexture": {"index": 0},
      "clearcoatRoughnessFactor": 0.5, "clearcoatRoughnessTexture": {"index": 1},
      "clearcoatNormalTexture": {"index": 2, "scale": 0.25}},
    "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1], "sheenColorTexture": {"index": 2},
      "sheenRoughnessFactor": 0.5, "sheenRoughnessTexture": {"index": 3}},
    "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 0.25,
      "anisotropyTexture": {"index": 4}},
    "KHR_materials_iridescence": {"iridescenceFactor": 0.5, "iridescenceTexture": {"index": 0},
      "iridescenceThicknessMinimum": 200, "iridescenceThicknessMaximum": 700,
      "iridescenceThicknessTexture": {"index": 1}},
    "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5,
      "diffuseTransmissionTexture": {"index": 3}, "diffuseTransmissionColorTexture": {"index": 2}}}})",
                {texel(51, 9, 9), texel(9, 102, 9), texel(0, 255, 0), texel(9, 9, 9, 204), texel(0, 128, 51)})
               .str());
  for (const std::string& warning : scene.warnings)
    EXPECT_EQ(warning.find("not looked at"), std::string::npos) << warning;
  const Surface surface(scene.materials[0]);
  const ShadingMaterial<1> m(surface, SampledSpectrum<1>(600.0f));
  EXPECT_NEAR(m.clearcoat(), 0.5f * 0.2f, 1e-6f);
  EXPECT_NEAR(m.clearcoat_roughness(), 0.5f * 0.4f, 1e-6f);
  EXPECT_TRUE(surface.coat_has_normals && !surface.maps_normals && scene.materials[0].needs_tangents);
  EXPECT_FALSE(surface.textures->clearcoat_normal.srgb);
  EXPECT_EQ(surface.textures->clearcoat_normal_scale, 0.25f);
  EXPECT_NEAR(m.sheen_roughness(), 0.5f * 0.8f, 1e-6f);
  EXPECT_NEAR(m.grain().strength, 0.5f * 0.2f, 1e-6f);
  EXPECT_NEAR(m.grain().rotation, 0.25f + kPi, 0.01f);
  EXPECT_NEAR(m.iridescence(), 0.5f * 0.2f, 1e-6f);
  EXPECT_NEAR(m.film_thickness(), 200 + 500 * 0.4f, 1e-3f);
  EXPECT_NEAR(m.diffuse_transmission(), 0.5f * 0.8f, 1e-6f);
  const float green = tabulated_reflectance(0, 1, 0)(600.0f);
  EXPECT_NEAR(m.sheen_color()[0], green, 1e-5f);
  EXPECT_NEAR(m.diffuse_transmission_color()[0], green, 1e-5f);
}

/// A measured reflectance keeps its shape; the texture gives its luminance.
TEST_F(GltfTextures, MeasuredReflectanceTimesLuminance) {
  const Scene scene = load(file(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
    "extras": {"reflectance_spectrum": {"nm": [400, 700], "value": [0, 1]}}})",
                                {texel(0, 255, 0)})
                               .str());
  const Surface surface(scene.materials[0]);
  SampledSpectrum<1> lambda(550.0f);
  EXPECT_NEAR(ShadingMaterial<1>(surface, lambda).base_color()[0], 0.5 * 0.7152, 1e-4);
}

TEST_F(GltfTextures, TransformsAndSets) {
  const Scene scene = load(file(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1,
    "extensions": {"KHR_texture_transform": {"offset": [0.25, 0.5], "scale": [2, 3], "rotation": 1.5707963267948966, "texCoord": 2}}}},
    "normalTexture": {"index": 0, "scale": 0.5}})",
                                {texel(1, 2, 3)})
                               .str());
  const MaterialTextures& textures = *scene.materials[0].textures;
  EXPECT_EQ(textures.base_color.uv_set, 2);
  EXPECT_EQ(scene.materials[0].uv_sets, 0b101);
  EXPECT_TRUE(scene.materials[0].needs_tangents);
  EXPECT_EQ(textures.normal_scale, 0.5f);
  EXPECT_EQ(textures.base_color.image, textures.normal.image);  // decoded once
  // Scaled to (2, 3), turned a quarter against the clock with v pointing down, then moved.
  const Vec2f at = textures.base_color.transform({1, 1});
  EXPECT_NEAR(at.x, 3 + 0.25f, 1e-5f);
  EXPECT_NEAR(at.y, -2 + 0.5f, 1e-5f);
}

TEST_F(GltfTextures, SamplersSetWrapAndFilter) {
  SquareFile f = file(kBase, {texel(1, 2, 3)});
  f.more = fmt::format(
      R"(, "images": [{{"uri": "{}"}}], "textures": [{{"source": 0, "sampler": 0}}], "samplers": [{{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}}])",
      texel(1, 2, 3));
  const Texture texture = load(f.str()).materials[0].textures->base_color;
  EXPECT_EQ(texture.wrap_u, Wrap::clamp);
  EXPECT_EQ(texture.wrap_v, Wrap::mirror);
  EXPECT_TRUE(texture.nearest);
}

TEST_F(GltfTextures, ImagesInFilesAndBuffers) {
  const std::string png = make_png(1, 1, PngColor::rgb, {1, 2, 3});
  write("a b.png", png);
  const Scene named = load(file(kBase, {"a%20b.png"}).str());
  EXPECT_EQ(named.materials[0].textures->base_color.image->channels, 3);

  SquareFile f = file(kBase, {});
  f.tail = png;
  f.views += fmt::format(R"(, {{"buffer": 0, "byteOffset": 60, "byteLength": {}}})", png.size());
  f.more = R"(, "images": [{"bufferView": 2, "mimeType": "image/png"}], "textures": [{"source": 0}])";
  EXPECT_EQ(load(f.str()).materials[0].textures->base_color.image->width, 1);
}

TEST_F(GltfTextures, OnlyUsedImagesAreLookedAt) {
  SquareFile f = file(R"({"name": "used"}, {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
                      {"nowhere.png"});
  EXPECT_EQ(load(f.str()).materials[1].textures, nullptr);
  // Occlusion and thickness are not read either.
  f = file(
      R"({"occlusionTexture": {"index": 0}, "extensions": {"KHR_materials_volume": {"thicknessTexture": {"index": 0}}}})",
      {"nowhere.png"});
  EXPECT_EQ(load(f.str()).materials[0].textures, nullptr);
}

TEST_F(GltfTextures, RefusalsNameThePlace) {
  const std::string missing = refusal(file(kBase, {"nowhere.png"}).str());
  EXPECT_NE(missing.find("#/images/0/uri"), std::string::npos) << missing;
  EXPECT_NE(missing.find("nowhere.png"), std::string::npos) << missing;
  write("text.png", "this is no image");
  const std::string text = refusal(file(kBase, {"text.png"}).str());
  EXPECT_NE(text.find("text.png"), std::string::npos) << text;
  EXPECT_NE(text.find("neither a PNG nor a JPEG"), std::string::npos) << text;

  SquareFile f = file(kBase, {texel(1, 2, 3)});
  f.more =
      R"(, "textures": [{"extensions": {"EXT_texture_webp": {"source": 0}}}], "images": [{"uri": "a.webp"}])";
  EXPECT_NE(refusal(f.str()).find("EXT_texture_webp"), std::string::npos);
  // … but with an image to fall back on, that is taken.
  f.more = fmt::format(
      R"(, "textures": [{{"source": 0, "extensions": {{"EXT_texture_webp": {{"source": 1}}}}}}], "images": [{{"uri": "{}"}}, {{"uri": "a.webp"}}])",
      texel(1, 2, 3));
  EXPECT_NE(load(f.str()).materials[0].textures, nullptr);
}

TEST_F(GltfTextures, CoverageByModeAndCutoff) {
  const auto coverage = [&](const std::string& mode, int alpha) {
    const Scene scene = load(file(R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5],
      "baseColorTexture": {"index": 0}}, )" +
                                      mode + "}",
                                  {texel(255, 255, 255, alpha)})
                                 .str());
    return Surface(scene.materials[0]).coverage({});
  };
  EXPECT_EQ(coverage(R"("alphaMode": "OPAQUE")", 51), 1.0f);
  EXPECT_NEAR(coverage(R"("alphaMode": "BLEND")", 51), 0.1f, 1e-6f);
  EXPECT_EQ(coverage(R"("alphaMode": "MASK", "alphaCutoff": 0.09)", 51), 1.0f);
  EXPECT_EQ(coverage(R"("alphaMode": "MASK", "alphaCutoff": 0.11)", 51), 0.0f);
  // What cannot let anything through is not asked.
  const Scene opaque = load(file(R"({"alphaMode": "BLEND"})", {}).str());
  EXPECT_FALSE(Surface(opaque.materials[0]).partly_covers);
}

}  // namespace
}  // namespace photopic
