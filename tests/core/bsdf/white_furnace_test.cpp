#include <gtest/gtest.h>

#include "core/bsdf/fresnel.h"
#include "core/bsdf/microfacet.h"
#include "support/bsdf_checks.h"
#include "support/layered_materials.h"

namespace photopic {
namespace {

using namespace test;

const ConstantSpectrum kWhite{1.0};

/// Perceptual; with those just above and beside kSmoothAlpha's.
constexpr std::array kRoughnesses{0.0f, 0.031f, 0.033f, 0.04f, 0.055f, 0.08f, 0.13f,
                                  0.2f, 0.3f,   0.45f,  0.6f,  0.8f,   1.0f};
constexpr std::array kCosines{1.0, 0.85, 0.5, 0.25, 0.1, 0.04, 0.012, 0.003};

std::string at(const std::string& what, float roughness, double cos_theta) {
  return what + " roughness " + std::to_string(roughness) + " cos " + std::to_string(cos_theta);
}

/// No light is lost or gained, wherever one looks from.
Furnace expect_white(const LocalBsdf& bsdf, Vec3f wo, const std::string& what, double ior = 1.0) {
  const Furnace f = furnace(bsdf, wo, ior);
  EXPECT_NEAR(f.albedo.mean, 1.0, 0.005) << what << " error " << f.albedo.error;
  EXPECT_LT(f.albedo.error, 0.001) << what;
  return f;
}
/// The same of opaque materials, of which besides all samples are worth about the same.
void expect_white(const Material& m, const std::string& what, int lane = 1) {
  const LocalBsdf bsdf = local_bsdf(m, lane);
  for (double cos_theta : kCosines) {
    const std::string where = at(what, m.roughness, cos_theta);
    const Furnace f = expect_white(bsdf, direction(cos_theta), where);
    EXPECT_LT(f.variance, 2.0) << where;
    EXPECT_LT(f.largest, 20.0) << where;
  }
}

TEST(WhiteFurnace, Opaque) {
  for (float roughness : kRoughnesses) {
    expect_white(metal(kWhite, roughness), "metal");
    for (float ior : {1.0f, 1.5f, 4.0f, 0.0f})
      expect_white(plastic(kWhite, roughness, ior), "plastic of ior " + std::to_string(ior));
    Material bright = plastic(kWhite, roughness);
    bright.specular_scale = 8.0f;
    expect_white(bright, "plastic of bright specular colour");
    Material mixed = plastic(kWhite, roughness);
    mixed.specular = 0.4f;
    expect_white(mixed, "less specular plastic");
    mixed.metallic = 0.5f;
    expect_white(mixed, "half metal");
  }
  expect_white(diffuse(kWhite), "diffuse");
}

TEST(WhiteFurnace, Conductor) {
  for (float roughness : kRoughnesses) expect_white(perfect_conductor(roughness), "conductor");
}

/// What a coat, a sheen or a film takes, the white beneath does not get.
TEST(WhiteFurnace, Coats) {
  for (float roughness : kRoughnesses)
    for (float coat : {0.0f, 0.2f, 0.7f}) {
      const std::string under = "under coat of " + std::to_string(coat) + ", ";
      expect_white(coated(metal(kWhite, roughness), coat), under + "metal");
      expect_white(coated(plastic(kWhite, 0.4f), roughness, 0.5f), under + "plastic");
    }
}

TEST(WhiteFurnace, SheenAndTranslucency) {
  for (float roughness : kRoughnesses) {
    expect_white(with_sheen(diffuse(kWhite), roughness, 1.0), "sheen " + std::to_string(roughness));
    expect_white(with_sheen(plastic(kWhite, roughness), 0.3f), "sheen on plastic");
    expect_white(translucent(plastic(kWhite, roughness)), "translucent");
  }
}

TEST(WhiteFurnace, Films) {
  for (float roughness : kRoughnesses)
    for (float thickness : {120.0f, 400.0f, 1000.0f}) {
      const std::string film = "film of " + std::to_string(thickness) + " nm on ";
      expect_white(iridescent(plastic(kWhite, roughness), thickness), film + "plastic");
      expect_white(iridescent(metal(kWhite, roughness), thickness), film + "metal");
    }
  for (float roughness : kRoughnesses)
    for (int lane : {0, 2})
      expect_white(iridescent(plastic(kWhite, roughness, 4.0f), 2000.0f), "film of many fringes", lane);
}

/// At every wavelength.
TEST(WhiteFurnace, Everything) {
  for (float roughness : kRoughnesses) {
    expect_white(everything(plastic(kWhite, roughness)), "everything on plastic");
    Material mixed = metal(kWhite, roughness);
    mixed.metallic = 0.5f;
    for (int lane : {0, 3}) expect_white(everything(mixed, 0.1f), "everything on half metal", lane);
  }
}

/// Brushed surfaces, seen along, askew and across the grain.
void expect_white_brushed(Material m, float strength, const std::string& what, int lane = 1) {
  m = brushed(m, strength);
  for (float azimuth : {0.0f, 0.6f, 1.2f, 1.5707963f}) {
    m.extensions.anisotropy_rotation = 0.7f + azimuth;  // direction() stands at 0.7
    const LocalBsdf bsdf = local_bsdf(m, lane);
    for (double cos_theta : kCosines) {
      const std::string where = at(what, m.roughness, cos_theta) + " strength " + std::to_string(strength) +
                                " azimuth " + std::to_string(azimuth);
      EXPECT_LT(expect_white(bsdf, direction(cos_theta), where).largest, 20.0) << where;
    }
  }
}

TEST(WhiteFurnace, BrushedMetal) {
  for (float roughness : {0.0f, 0.1f, 0.2f, 0.6f})
    for (float strength : {0.05f, 0.3f, 0.7f, 1.0f})
      expect_white_brushed(metal(kWhite, roughness), strength, "metal");
}

TEST(WhiteFurnace, BrushedPlastic) {
  for (float roughness : {0.0f, 0.2f, 0.6f})
    for (float strength : {0.05f, 0.7f, 1.0f})
      expect_white_brushed(plastic(kWhite, roughness), strength, "plastic");
}

/// Roughness and strength may as well be a texture's: there is but one table.
TEST(WhiteFurnace, FilmsOnBrushed) {
  for (float roughness : {0.0f, 0.2f, 0.6f})
    for (float strength : {0.3f, 1.0f})
      expect_white_brushed(iridescent(plastic(kWhite, roughness), 400.0f), strength, "film on plastic");
  for (float roughness : {0.0f, 0.13f, 0.9f})
    for (float strength : {0.05f, 0.94f})
      expect_white_brushed(iridescent(plastic(kWhite, roughness, 4.0f), 2000.0f), strength,
                           "film of many fringes", 0);
}

/// What one bounce off the microsurface keeps of light seen at cos θ = mu; by sampling.
double one_bounce(Ggx ggx, double mu, const std::function<float(float)>& fresnel) {
  constexpr std::uint32_t kSamples = 2048;
  const Vec3f wo = direction(mu);
  double kept = 0.0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Vec3f m = ggx.sample_visible(wo, SampleStream(Sequence::sobol, 9, 0, i).get_2d(0));
    const Vec3f wi = reflect(wo, m);
    if (wi.z > 0.0f) kept += fresnel(dot(wo, m)) * ggx.g2(wo, wi) / ggx.g1(wo) / kSamples;
  }
  return kept;
}
double cosine_average(const std::function<double(double)>& f) {
  constexpr int kSteps = 64;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += 2.0 * (i + 0.5) / kSteps * f((i + 0.5) / kSteps) / kSteps;
  return sum;
}

/// A lossy metal reflects what bounces off once, and of what remains F̄²Ē/(1 − F̄(1 − Ē)), bars being averages
/// weighed by the cosine (Kulla & Conty 2017).
TEST(WhiteFurnace, LossyConductorIsAClosedForm) {
  const auto fresnel = [](float c) { return fresnel_conductor(c, 0.3f, 1.5f); };
  const auto white = [](float) { return 1.0f; };
  const double f = cosine_average([&](double mu) { return fresnel(static_cast<float>(mu)); });
  for (float roughness : {0.5f, 1.0f}) {
    Material metal_of_index = metal(kWhite, roughness);
    metal_of_index.extensions.conductor =
        ConductorIndex{{{400.0}, {0.3}, Beyond::end_value}, {{400.0}, {1.5}, Beyond::end_value}};
    const Ggx ggx{roughness * roughness};
    const double e = cosine_average([&](double mu) { return one_bounce(ggx, mu, white); });
    for (double mu : {0.95, 0.4, 0.1}) {
      const double further = f * f * e / (1.0 - f * (1.0 - e)) * (1.0 - one_bounce(ggx, mu, white));
      EXPECT_NEAR(furnace(local_bsdf(metal_of_index), direction(mu)).albedo.mean,
                  one_bounce(ggx, mu, fresnel) + further, 0.005)
          << roughness << ' ' << mu;
    }
  }
}

/// Whichever side light comes from, at every index.
void expect_white_glass(const Material& m, double ior, const std::string& what, int lane = 1) {
  const LocalBsdf bsdf = local_bsdf(m, lane);
  for (double cos_theta : {1.0, 0.7, 0.3, 0.1, 0.02, 0.003})
    for (double side : {1.0, -1.0})
      expect_white(bsdf, direction(side * cos_theta), at(what, m.roughness, side * cos_theta), ior);
}

Material film_of_air(const Material& m) {
  Material filmed = iridescent(m, 400.0f);
  filmed.extensions.iridescence_ior = 1.0f;
  return filmed;
}

constexpr std::array kGlassRoughnesses{0.0f, 0.033f, 0.055f, 0.13f, 0.3f, 0.6f, 1.0f};

TEST(WhiteFurnace, SolidGlass) {
  for (float roughness : kGlassRoughnesses)
    for (float ior : {1.01f, 1.5f, 2.4f, 4.0f})
      expect_white_glass(solid_glass(ior, roughness), ior, "solid ior " + std::to_string(ior));
}

TEST(WhiteFurnace, ThinGlass) {
  for (float roughness : kGlassRoughnesses) {
    for (float ior : {1.01f, 1.5f, 4.0f})
      expect_white_glass(thin_glass(ior, roughness), 1.0, "thin ior " + std::to_string(ior));
    expect_white_glass(iridescent(thin_glass(1.5f, roughness), 400.0f), 1.0, "film on thin glass");
  }
}

TEST(WhiteFurnace, FilmsOnSolidGlass) {
  for (float roughness : kGlassRoughnesses)
    for (float ior : {1.5f, 2.4f})
      for (float thickness : {120.0f, 400.0f, 1000.0f})
        expect_white_glass(iridescent(solid_glass(ior, roughness), thickness), ior,
                           "film of " + std::to_string(thickness) + " nm on ior " + std::to_string(ior));
}

/// glTF allows the index 1: no film.
TEST(WhiteFurnace, FilmsOfIndexOne) {
  for (float roughness : {0.0f, 0.055f, 0.3f, 1.0f}) {
    expect_white(film_of_air(plastic(kWhite, roughness)), "film of air on plastic");
    expect_white_glass(film_of_air(solid_glass(1.5f, roughness)), 1.5, "film of air on glass");
    expect_white_glass(film_of_air(thin_glass(1.5f, roughness)), 1.0, "film of air on thin glass");
  }
}

TEST(WhiteFurnace, DispersiveGlass) {
  for (float roughness : {0.0f, 0.055f, 0.3f, 1.0f})
    for (int lane : {0, 3}) {
      const double ior = refractive_index(glass_index("SF11").value(), 450.0 + 50.0 * lane);
      expect_white_glass(dispersive(solid_glass(1.5f, roughness), "SF11"), ior, "SF11", lane);
    }
}

}  // namespace
}  // namespace photopic
