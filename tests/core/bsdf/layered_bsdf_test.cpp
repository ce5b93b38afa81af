#include <gtest/gtest.h>

#include "core/sampling.h"
#include "support/bsdf_checks.h"
#include "support/layered_materials.h"

namespace photopic {
namespace {

using namespace test;

const ConstantSpectrum kWhite{1.0};

Vec3f mirrored(Vec3f wo) {
  return {-wo.x, -wo.y, wo.z};
}

void expect_consistent(const Material& material, Vec3f wo, Vec3f axis, std::size_t tests,
                       const std::string& what) {
  constexpr int kSamples = 20000;
  const BsdfReport r = examine(local_bsdf(material, 2), wo, axis, kSamples, 23);
  EXPECT_GT(r.chi_square_p, sidak_significance(0.01, tests)) << what;
  EXPECT_LT(r.pdf_integral, 1.0 + 5e-4) << what;
  const double z = z_score(r.albedo, {r.albedo_quadrature, 3e-4});
  EXPECT_LT(std::abs(z), normal_threshold(sidak_significance(0.01, tests)))
      << what << ": sampled " << r.albedo.mean << ", quadrature " << r.albedo_quadrature;
}

TEST(LayeredBsdf, SamplesItsDensity) {
  const ConstantSpectrum grey{0.5};
  Material mixed = plastic(grey, 0.5f);
  mixed.metallic = 0.4f;
  const std::vector<std::pair<std::string, Material>> materials{
      {"coat", coated(plastic(grey, 0.5f), 0.2f)},
      {"coat on metal", coated(metal(grey, 0.15f), 0.6f, 0.7f)},
      {"sheen", with_sheen(diffuse(grey), 0.4f)},
      {"smooth sheen", with_sheen(plastic(grey, 0.3f), 0.0f)},
      {"rough sheen", with_sheen(plastic(grey, 1.0f), 1.0f)},
      {"brushed", brushed(metal(grey, 0.3f), 0.7f)},
      {"brushed plastic", brushed(plastic(grey, 0.1f), 0.3f)},
      {"film", iridescent(plastic(grey, 0.3f), 400.0f)},
      {"film on rough metal", iridescent(metal(grey, 0.9f), 200.0f)},
      {"translucent", translucent(plastic(grey, 0.4f))},
      {"mostly translucent", translucent(diffuse(grey), 0.9f)},
      {"everything", everything(plastic(grey, 0.5f))},
      {"everything, smooth", everything(plastic(grey, 0.1f), 0.08f)},
      {"everything, half metal", everything(mixed)},
      {"gold", of_metal("Au", 0.3f)},
      {"smooth silver", of_metal("Ag", 0.06f)},
      {"rough silver", of_metal("Ag", 1.0f)},
      {"coated film on copper", coated(iridescent(of_metal("Cu", 0.4f), 300.0f), 0.2f)}};
  for (const auto& [name, material] : materials)
    for (double cos_theta : {0.95, 0.4, 0.1})
      expect_consistent(material, direction(cos_theta), mirrored(direction(cos_theta)), 3 * materials.size(),
                        name + " " + std::to_string(cos_theta));
}

/// Glass seen at one wavelength of four that share their samples: dispersive, and with films.
TEST(SpectralGlassBsdf, SamplesItsDensity) {
  std::vector<std::pair<std::string, Material>> materials;
  for (float roughness : {0.15f, 0.5f, 1.0f}) {
    materials.emplace_back("SF11", dispersive(solid_glass(1.5f, roughness), "SF11"));
    materials.emplace_back("film on glass", iridescent(solid_glass(1.5f, roughness), 400.0f));
    materials.emplace_back("film on SF11",
                           iridescent(dispersive(solid_glass(1.5f, roughness), "SF11"), 300.0f));
    materials.emplace_back("film on thin glass", iridescent(thin_glass(1.5f, roughness), 400.0f));
  }
  for (const auto& [name, material] : materials)
    for (double cos_theta : {0.9, 0.3, -0.9, -0.3}) {
      const Vec3f wo = direction(cos_theta);
      expect_consistent(
          material, wo, -wo, 4 * materials.size(),
          name + " " + std::to_string(material.roughness) + " cos " + std::to_string(cos_theta));
    }
}

TEST(ConductorBsdf, SmoothReflectanceAtNormalIncidence) {
  const ConductorIndex gold = conductor_index("Au").value();
  for (int lane = 0; lane < 4; ++lane) {
    const double lambda = 450.0 + 50.0 * lane, n = gold.n(lambda), k = gold.k(lambda);
    EXPECT_NEAR(sampled_albedo(local_bsdf(of_metal("Au", 0.0f), lane), {0, 0, 1}, 4).mean,
                ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k), 1e-5);
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
