#include <gtest/gtest.h>

#include "core/sampling.h"
#include "support/bsdf_checks.h"
#include "support/scene_builder.h"

namespace photopic {
namespace {

using namespace test;

const ConstantSpectrum kWhite{1.0};

Material coated(Material m, float roughness) {
  m.extensions.clearcoat = 1.0f;
  m.extensions.clearcoat_roughness = roughness;
  return m;
}
Material with_sheen(Material m, float roughness) {
  m.extensions.sheen_color = ConstantSpectrum{0.8};
  m.extensions.sheen_roughness = roughness;
  return m;
}
Material brushed(Material m, float strength) {
  m.extensions.anisotropy = strength;
  m.extensions.anisotropy_rotation = 0.4f;
  return m;
}
Material iridescent(Material m, float thickness) {
  m.extensions.iridescence = 1.0f;
  m.extensions.iridescence_ior = 1.8f;
  m.extensions.iridescence_thickness = thickness;
  return m;
}
Material translucent(Material m) {
  m.extensions.diffuse_transmission = 0.3f;
  return m;
}
Material of_metal(const char* name, float roughness) {
  Material m = metal(kWhite, roughness);
  m.extensions.conductor = conductor_index(name);
  return m;
}

Vec3f mirrored(Vec3f wo) {
  return {-wo.x, -wo.y, wo.z};
}

void expect_consistent(const Material& material, Vec3f wo, std::size_t tests, const std::string& what) {
  constexpr int kSamples = 20000;
  const BsdfReport r = examine(local_bsdf(material, 2), wo, mirrored(wo), kSamples, 23);
  EXPECT_GT(r.chi_square_p, sidak_significance(0.01, tests)) << what;
  EXPECT_LT(r.pdf_integral, 1.0 + 5e-4) << what;
  EXPECT_LT(r.worst_weight, 0.01) << what;
  EXPECT_LT(r.worst_pdf, 0.01) << what;
  const double z = z_score(r.albedo, {r.albedo_quadrature, 3e-4});
  EXPECT_LT(std::abs(z), normal_threshold(sidak_significance(0.01, tests)))
      << what << ": sampled " << r.albedo.mean << ", quadrature " << r.albedo_quadrature;
}

TEST(LayeredBsdf, SamplesItsDensity) {
  const ConstantSpectrum grey{0.5};
  const std::vector<std::pair<std::string, Material>> materials{
      {"coat", coated(plastic(grey, 0.5f), 0.2f)},
      {"sheen", with_sheen(diffuse(grey), 0.4f)},
      {"brushed", brushed(metal(grey, 0.3f), 0.7f)},
      {"film", iridescent(plastic(grey, 0.3f), 400.0f)},
      {"translucent", translucent(plastic(grey, 0.4f))},
      {"all",
       coated(with_sheen(brushed(iridescent(translucent(plastic(grey, 0.5f)), 500.0f), 0.5f), 0.6f), 0.3f)},
      {"gold", of_metal("Au", 0.3f)},
      {"coated film on copper", coated(iridescent(of_metal("Cu", 0.4f), 300.0f), 0.2f)}};
  for (const auto& [name, material] : materials)
    for (double cos_theta : {0.95, 0.4, 0.1})
      expect_consistent(material, direction(cos_theta), 3 * materials.size(),
                        name + " " + std::to_string(cos_theta));
}

void expect_white(const Material& m, double tolerance, const std::string& what) {
  const LocalBsdf bsdf = local_bsdf(m, 1);
  for (double cos_theta : {1.0, 0.6, 0.2, 0.03}) {
    const Estimate e = sampled_albedo(bsdf, direction(cos_theta), 1 << 14);
    EXPECT_NEAR(e.mean, 1.0, tolerance + e.error) << what << " cos " << cos_theta << " error " << e.error;
  }
}

/// White furnaces: what a coat, a sheen or a film takes, the white beneath it does not get, and nothing is
/// lost.
TEST(LayeredBsdf, WhiteFurnace) {
  for (float roughness : {0.0f, 0.1f, 0.4f, 1.0f}) {
    const std::string r = " " + std::to_string(roughness);
    for (float coat : {0.0f, 0.4f}) {
      expect_white(coated(plastic(kWhite, roughness), coat), 5e-3, "coat on plastic" + r);
      expect_white(coated(metal(kWhite, roughness), coat), 5e-3, "coat on metal" + r);
    }
    expect_white(with_sheen(diffuse(kWhite), roughness), 5e-3, "sheen" + r);
    expect_white(with_sheen(plastic(kWhite, 0.4f), roughness), 5e-3, "sheen on plastic" + r);
    expect_white(translucent(plastic(kWhite, roughness)), 5e-3, "translucent" + r);
    for (float thickness : {100.0f, 1000.0f}) {
      expect_white(iridescent(plastic(kWhite, roughness), thickness), 5e-3, "film on plastic" + r);
      expect_white(iridescent(metal(kWhite, roughness), thickness), 5e-3, "film on metal" + r);
    }
    for (float strength : {0.3f, 1.0f}) {
      expect_white(brushed(metal(kWhite, roughness), strength), 5e-3,
                   "brushed metal" + r + " " + std::to_string(strength));
      expect_white(brushed(plastic(kWhite, roughness), strength), 5e-3,
                   "brushed plastic" + r + " " + std::to_string(strength));
    }
  }
}

/// A metal that reflects all (k large) is white at every roughness; a real one reflects no more than its
/// smooth surface at grazing incidence and no less than a quarter of it.
TEST(ConductorBsdf, WhiteFurnaceAndSmoothReflectance) {
  for (float roughness : {0.0f, 0.05f, 0.2f, 0.5f, 0.75f, 1.0f}) {
    Material white = metal(kWhite, roughness);
    white.extensions.conductor =
        ConductorIndex{{{400.0}, {1e-3}, Beyond::end_value}, {{400.0}, {100.0}, Beyond::end_value}};
    expect_white(white, 5e-3, "perfect " + std::to_string(roughness));
  }
  const ConductorIndex gold = conductor_index("Au").value();
  for (int lane = 0; lane < 4; ++lane) {
    const double lambda = 450.0 + 50.0 * lane, n = gold.n(lambda), k = gold.k(lambda);
    EXPECT_NEAR(sampled_albedo(local_bsdf(of_metal("Au", 0.0f), lane), {0, 0, 1}, 4).mean,
                ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k), 1e-5);
  }
}

TEST(ConductorBsdf, IsReciprocal) {
  const LocalBsdf bsdf = local_bsdf(of_metal("Cu", 0.5f));
  for (std::uint32_t i = 0; i < 200; ++i) {
    const SampleStream stream(Sequence::independent, 2, 0, i);
    const Vec3f a = sample_cosine_hemisphere(stream.get_2d(0)),
                b = sample_cosine_hemisphere(stream.get_2d(1));
    const double ab = bsdf.evaluate(a, b).f_cos / b.z, ba = bsdf.evaluate(b, a).f_cos / a.z;
    EXPECT_NEAR(ab, ba, 1e-3 * (ab + 1e-3));
  }
}

/// Without coats, film or anisotropy the layered model is the plain one.
TEST(LayeredBsdf, OfNothingIsThePlainModel) {
  Material plain = plastic(ConstantSpectrum{0.4}, 0.35f);
  plain.metallic = 0.3f;
  Material layered = plain;
  layered.extensions.diffuse_transmission = 1e-9f;
  const LocalBsdf a = local_bsdf(plain), b = local_bsdf(layered);
  for (std::uint32_t i = 0; i < 100; ++i) {
    const SampleStream stream(Sequence::independent, 3, 0, i);
    const Vec3f wo = sample_cosine_hemisphere(stream.get_2d(0)),
                wi = sample_cosine_hemisphere(stream.get_2d(1));
    EXPECT_NEAR(a.evaluate(wo, wi).f_cos, b.evaluate(wo, wi).f_cos, 1e-2 * a.evaluate(wo, wi).f_cos + 1e-4);
  }
}

/// Brushed metal spreads light along x, and turning the grain by a right angle swaps the axes.
TEST(LayeredBsdf, AnisotropyHasADirection) {
  Material m = metal(kWhite, 0.3f);
  m.extensions.anisotropy = 0.8f;
  const LocalBsdf along = local_bsdf(m);
  m.extensions.anisotropy_rotation = 0.5f * kPi;
  const LocalBsdf across = local_bsdf(m);
  const Vec3f up{0, 0, 1}, x = normalize(Vec3f{0.5f, 0, 1}), y = normalize(Vec3f{0, 0.5f, 1});
  EXPECT_GT(along.evaluate(up, x).f_cos, 3.0 * along.evaluate(up, y).f_cos);
  EXPECT_NEAR(along.evaluate(up, x).f_cos, across.evaluate(up, y).f_cos, 1e-4);
}

/// Half of the light that a translucent base scatters goes through, in its own colour.
TEST(LayeredBsdf, DiffuseTransmission) {
  Material m = diffuse(ConstantSpectrum{0.6});
  m.extensions.diffuse_transmission = 0.5f;
  m.extensions.diffuse_transmission_color = ConstantSpectrum{0.4};
  const LocalBsdf bsdf = local_bsdf(m);
  const Vec3f wo = direction(0.7);
  EXPECT_NEAR(bsdf.evaluate(wo, {0, 0, 1}).f_cos, 0.5 * 0.6 / kPi, 1e-6);
  EXPECT_NEAR(bsdf.evaluate(wo, {0, 0, -1}).f_cos, 0.5 * 0.4 / kPi, 1e-6);
  EXPECT_NEAR(sampled_albedo(bsdf, wo, 4096).mean, 0.5, 1e-3);
}

}  // namespace
}  // namespace photopic
