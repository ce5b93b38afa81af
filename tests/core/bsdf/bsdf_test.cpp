#include <gtest/gtest.h>

#include "core/bsdf/microfacet.h"
#include "support/bsdf_checks.h"
#include "support/layered_materials.h"

namespace photopic {
namespace {

using namespace test;

constexpr int kSamples = 40000;

/// What holds for every BSDF without delta lobes: samples follow the density that evaluate() tells, failures
/// make up the rest of it, weights are f cos/pdf, and two ways to the albedo agree.
void expect_consistent(const Material& material, Vec3f wo, Vec3f axis, std::size_t tests,
                       const std::string& what) {
  const BsdfReport r = examine(local_bsdf(material), wo, axis, kSamples, 17);
  EXPECT_GT(r.chi_square_p, sidak_significance(0.01, tests)) << what;
  EXPECT_LT(r.pdf_integral, 1.0 + 5e-4) << what;
  EXPECT_LT(r.worst_weight, 0.01) << what;
  EXPECT_LT(r.worst_pdf, 0.01) << what;
  const double z = z_score(r.albedo, {r.albedo_quadrature, 2e-4});
  EXPECT_LT(std::abs(z), normal_threshold(sidak_significance(0.01, tests)))
      << what << ": sampled " << r.albedo.mean << ", quadrature " << r.albedo_quadrature;
}

Vec3f mirrored(Vec3f wo) {
  return {-wo.x, -wo.y, wo.z};
}

TEST(DiffuseBsdf, SamplesItsDensity) {
  expect_consistent(diffuse(ConstantSpectrum{0.6}), direction(0.5), {0, 0, 1}, 1, "diffuse");
  const LocalBsdf bsdf = local_bsdf(diffuse(ConstantSpectrum{0.6}));
  EXPECT_NEAR(sampled_albedo(bsdf, direction(0.5), 16).mean, 0.6, 1e-6);
  EXPECT_NEAR(bsdf.evaluate(direction(0.5), {0, 0, 1}).f_cos, 0.6 / 3.14159265, 1e-6);
  EXPECT_EQ(bsdf.evaluate(direction(0.5), {0, 0, -1}).f_cos, 0.0);
}

TEST(OpaqueBsdf, SamplesItsDensity) {
  Material mixed = plastic(ConstantSpectrum{0.5}, 0.0f);
  mixed.metallic = 0.4f;
  mixed.specular = 0.7f;
  const std::vector<Material> materials{metal(ConstantSpectrum{0.8}, 0), plastic(ConstantSpectrum{0.5}, 0),
                                        mixed};
  for (std::size_t i = 0; i < materials.size(); ++i)
    for (float roughness : {0.05f, 0.2f, 0.5f, 1.0f})
      for (double cos_theta : {1.0, 0.6, 0.1}) {
        Material m = materials[i];
        m.roughness = roughness;
        const Vec3f wo = direction(cos_theta);
        expect_consistent(m, wo, mirrored(wo), 36,
                          "material " + std::to_string(i) + " roughness " + std::to_string(roughness) +
                              " cos " + std::to_string(cos_theta));
      }
}

/// At normal incidence a mirror of ior n reflects ((n − 1)/(n + 1))², a metal its base colour.
TEST(OpaqueBsdf, SmoothReflectanceAtNormalIncidence) {
  const Vec3f up{0, 0, 1};
  EXPECT_NEAR(sampled_albedo(local_bsdf(plastic(ConstantSpectrum{0.0}, 0.0f, 2.0f)), up, 64).mean, 1.0 / 9.0,
              1e-5);
  EXPECT_NEAR(sampled_albedo(local_bsdf(metal(ConstantSpectrum{0.3}, 0.0f)), up, 64).mean, 0.3, 1e-5);
}

/// Where a smooth interface would send the light: the rough lobe's axis.
Vec3f refracted(Vec3f wo, float ior) {
  const float eta = wo.z > 0 ? ior : 1 / ior;
  const float sin2 = (1 - wo.z * wo.z) / (eta * eta);
  if (sin2 >= 1.0f) return mirrored(wo);
  return {-wo.x / eta, -wo.y / eta, std::copysign(std::sqrt(1 - sin2), -wo.z)};
}

TEST(GlassBsdf, SamplesItsDensity) {
  for (bool solid : {true, false})
    for (float roughness : {0.1f, 0.4f, 1.0f})
      for (float ior : {1.0f, 1.33f, 1.5f, 2.4f})
        for (double cos_theta : {0.9, 0.2, -0.9, -0.4}) {
          if (solid && ior == 1.0f) continue;  // a delta lobe
          const Vec3f wo = direction(cos_theta);
          const Vec3f axis = solid ? refracted(wo, ior) : -wo;
          expect_consistent(solid ? solid_glass(ior, roughness) : thin_glass(ior, roughness), wo, axis, 84,
                            std::string(solid ? "solid" : "thin") + " roughness " +
                                std::to_string(roughness) + " ior " + std::to_string(ior) + " cos " +
                                std::to_string(cos_theta));
        }
}

/// Smooth glass loses nothing: radiance scaled by 1/η² where it crosses, taken back, sums to one.
TEST(GlassBsdf, SmoothKeepsAllEnergy) {
  for (bool solid : {true, false})
    for (float ior : {0.0f, 1.0f, 1.000001f, 1.33f, 1.5f, 4.0f})
      for (double cos_theta : {1.0, 0.5, 0.01, -0.01, -0.5, -1.0}) {
        const LocalBsdf bsdf = local_bsdf(solid ? solid_glass(ior, 0.0f) : thin_glass(ior, 0.0f));
        EXPECT_NEAR(sampled_albedo(bsdf, direction(cos_theta), 256, true).mean, 1.0, 1e-5)
            << solid << ' ' << ior << ' ' << cos_theta;
      }
}

TEST(GlassBsdf, SmoothDirections) {
  const LocalBsdf glass = local_bsdf(solid_glass(1.5f, 0.0f));
  for (double cos_theta : {0.8, 0.2, -0.9}) {
    const Vec3f wo = direction(cos_theta);
    const auto passed = glass.sample(wo, 0.9999f, {0.5f, 0.5f});
    ASSERT_TRUE(passed && passed->delta);
    EXPECT_LT(length(passed->wi - refracted(wo, 1.5f)), 1e-6f);
    EXPECT_NEAR(passed->weight, cos_theta > 0 ? 1 / 2.25 : 2.25, 1e-5);
    const auto reflected = glass.sample(wo, 0.0f, {0.5f, 0.5f});
    ASSERT_TRUE(reflected);
    EXPECT_LT(length(reflected->wi - mirrored(wo)), 1e-6f);
    EXPECT_EQ(reflected->weight, 1.0);
  }
}

/// Rough glass keeps all energy too, whichever side light comes from, however near to air it is.
TEST(GlassBsdf, RoughKeepsAllEnergy) {
  for (float roughness : {0.04f, 0.33f, 0.7f, 1.0f})
    for (float ior : {1.001f, 1.05f, 1.33f, 1.8f})
      for (double cos_theta : {1.0, 0.5, 0.04, -0.04, -0.5, -1.0}) {
        const Estimate e = furnace(local_bsdf(solid_glass(ior, roughness)), direction(cos_theta), ior).albedo;
        EXPECT_NEAR(e.mean, 1.0, 5e-3) << roughness << ' ' << ior << ' ' << cos_theta;
        EXPECT_LT(e.error, 1e-3) << roughness << ' ' << ior << ' ' << cos_theta;
      }
}

/// KHR_materials_specular on glass: what is not reflected passes, total reflection stays. A colour makes it
/// spectral.
Material with_specular(Material m, float factor, float color) {
  m.specular = factor;
  m.specular_color = ConstantSpectrum{std::min(color, 1.0f)};
  m.specular_scale = std::max(color, 1.0f);
  return m;
}

TEST(GlassBsdf, SpecularFactorsKeepAllEnergy) {
  for (bool solid : {true, false})
    for (float roughness : {0.0f, 0.3f, 0.8f})
      for (auto [factor, color] : {std::pair{0.0f, 1.0f},
                                   {0.4f, 1.0f},
                                   {1.0f, 0.2f},
                                   {0.7f, 0.5f},
                                   {1.0f, 2.0f},
                                   {0.7f, 9.0f},
                                   {1.0f, 99.0f}})
        for (double cos_theta : {1.0, 0.5, 0.04, -0.04, -0.5, -1.0}) {
          const Material m = solid ? solid_glass(1.5f, roughness) : thin_glass(1.5f, roughness);
          const LocalBsdf bsdf = local_bsdf(with_specular(m, factor, color));
          const Estimate e = furnace(bsdf, direction(cos_theta), solid ? 1.5 : 1.0).albedo;
          EXPECT_NEAR(e.mean, 1.0, 5e-3)
              << solid << ' ' << roughness << ' ' << factor << ' ' << color << ' ' << cos_theta;
          EXPECT_LT(e.error, 1e-3) << solid << ' ' << roughness << ' ' << cos_theta;
        }
}

TEST(GlassBsdf, SpecularFactorsScaleTheReflection) {
  const auto reflected = [](const Material& m, double cos_theta) {
    const LocalBsdf bsdf = local_bsdf(m);
    const Vec3f wo = direction(cos_theta);
    double sum = 0.0;
    for (int i = 0; i < 4096; ++i)
      if (const auto s = bsdf.sample(wo, (static_cast<float>(i) + 0.5f) / 4096, {0.5f, 0.5f}))
        if (s->wi.z * wo.z > 0.0f) sum += s->weight / 4096;
    return sum;
  };
  const Material glass = solid_glass(1.5f, 0.0f);
  EXPECT_NEAR(reflected(with_specular(glass, 0.5f, 1.0f), 1.0), 0.02, 5e-4);
  EXPECT_NEAR(reflected(with_specular(glass, 0.5f, 0.5f), -1.0), 0.01, 5e-4);
  EXPECT_NEAR(reflected(with_specular(glass, 0.0f, 1.0f), 0.3), 0.0, 1e-6);
  EXPECT_NEAR(reflected(with_specular(glass, 0.0f, 1.0f), -0.5), 1.0, 1e-6);  // total
  // Seen along one ray from either side it is the same; towards grazing the colour is lost.
  const Material tinted = with_specular(glass, 1.0f, 0.1f);
  const double outside = 0.2, inside = std::sqrt(1 - (1 - outside * outside) / 2.25);
  EXPECT_NEAR(reflected(tinted, outside), reflected(tinted, -inside), 2e-3);
  EXPECT_GT(reflected(tinted, 0.02), 0.85 * reflected(glass, 0.02));
  // A colour above 1 scales what is reflected at normal incidence, up to all of it.
  const Material bright = with_specular(glass, 1.0f, 2.0f);
  EXPECT_NEAR(reflected(bright, 1.0), 0.08, 5e-4);
  EXPECT_NEAR(reflected(bright, -1.0), 0.08, 5e-4);
  EXPECT_NEAR(reflected(bright, -0.5), 1.0, 1e-6);
  EXPECT_NEAR(reflected(bright, outside), reflected(bright, -inside), 2e-3);
  EXPECT_GT(reflected(bright, outside), reflected(glass, outside));
  EXPECT_NEAR(reflected(with_specular(glass, 0.5f, 30.0f), 0.7), 0.5, 5e-4);
}

/// F0 = min(((n − 1)/(n + 1))²·color, 1)·specularFactor, whatever lies over or under the surface.
TEST(OpaqueBsdf, SpecularColorsAboveOneScaleF0) {
  const Material black = plastic(ConstantSpectrum{0.0}, 0.0f);
  const auto reflected = [](const Material& m) { return sampled_albedo(local_bsdf(m), {0, 0, 1}, 64).mean; };
  for (const bool layered : {false, true})
    for (auto [factor, color, f0] : {std::array{1.0f, 1.0f, 0.04f},
                                     {1.0f, 2.0f, 0.08f},
                                     {0.5f, 2.0f, 0.04f},
                                     {1.0f, 24.0f, 0.96f},
                                     {0.5f, 50.0f, 0.5f}}) {
      const Material m = with_specular(layered ? with_sheen(black, 0.5f, 1e-9) : black, factor, color);
      EXPECT_NEAR(reflected(m), f0, 1e-4) << layered << ' ' << factor << ' ' << color;
    }
}

TEST(GlassBsdf, WithSpecularFactorsSamplesItsDensity) {
  for (float color : {1.0f, 0.3f, 3.0f})
    for (double cos_theta : {0.9, 0.2, -0.9, -0.4}) {
      const Vec3f wo = direction(cos_theta);
      expect_consistent(with_specular(solid_glass(1.5f, 0.4f), 0.5f, color), wo, refracted(wo, 1.5f), 12,
                        std::to_string(color) + " cos " + std::to_string(cos_theta));
    }
}

/// Rough interfaces obey the reciprocity of radiance, f(a,b)·η_b² = f(b,a)·η_a² (Walter et al. 2007, section
/// 2), with the light that is given back.
TEST(GlassBsdf, RoughRefractionIsReciprocalUpToIndex) {
  const float ior = 1.5f;
  const LocalBsdf bsdf = local_bsdf(solid_glass(ior, 0.6f));
  int compared = 0;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const SampleStream stream(Sequence::independent, 4, 0, i);
    const Vec3f a = sample_cosine_hemisphere(stream.get_2d(0)),
                b = -sample_cosine_hemisphere(stream.get_2d(1));
    const double ab = bsdf.evaluate(a, b).f_cos / -b.z, ba = bsdf.evaluate(b, a).f_cos / a.z;
    EXPECT_NEAR(ab * ior * ior, ba, 2e-3 * (ba + 1e-3));
    compared += ba > 0.0;
  }
  EXPECT_GT(compared, 50);
}

}  // namespace
}  // namespace photopic
