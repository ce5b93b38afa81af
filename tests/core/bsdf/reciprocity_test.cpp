#include <gtest/gtest.h>

#include "core/sampling.h"
#include "support/bsdf_checks.h"
#include "support/layered_materials.h"

namespace photopic {
namespace {

using namespace test;

const ConstantSpectrum kGrey{0.6};

struct Directions {
  Vec3f a, b;
};
/// In the upper hemisphere.
Directions directions(std::uint32_t i) {
  const SampleStream stream(Sequence::independent, 2, 0, i);
  return {sample_cosine_hemisphere(stream.get_2d(0)), sample_cosine_hemisphere(stream.get_2d(1))};
}
double brdf(const LocalBsdf& bsdf, Vec3f wo, Vec3f wi) {
  return bsdf.evaluate(wo, wi).f_cos / std::abs(wi.z);
}

void expect_reciprocal(const Material& m, const std::string& what) {
  const LocalBsdf bsdf = local_bsdf(m);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto [a, b] = directions(i);
    const double ab = brdf(bsdf, a, b), ba = brdf(bsdf, b, a);
    EXPECT_NEAR(ab, ba, 1e-3 * (ab + 1e-3)) << what << " roughness " << m.roughness;
  }
}

/// f(a, b) = f(b, a), further bounces, films and sheen included.
TEST(Reciprocity, Opaque) {
  for (float roughness : {0.1f, 0.4f, 1.0f}) {
    Material mixed = plastic(kGrey, roughness);
    mixed.metallic = 0.4f;
    for (const Material& base : {metal(kGrey, roughness), plastic(kGrey, roughness), mixed}) {
      expect_reciprocal(base, "plain");
      expect_reciprocal(brushed(base, 0.7f), "brushed");
      expect_reciprocal(iridescent(base, 400.0f), "film");
      expect_reciprocal(translucent(base), "translucent");
      expect_reciprocal(brushed(iridescent(translucent(base), 400.0f), 0.5f), "all but coats");
    }
    expect_reciprocal(of_metal("Cu", roughness), "copper");
    expect_reciprocal(iridescent(of_metal("Cu", roughness), 300.0f), "film on copper");
    Material black = diffuse(ConstantSpectrum{0.0});
    expect_reciprocal(coated(black, roughness), "coat alone");
  }
  expect_reciprocal(diffuse(kGrey), "diffuse");
}

/// What goes through: the viewer is above in either case, the frame being turned to his side.
TEST(Reciprocity, DiffuseTransmission) {
  const auto other_side = [](Vec3f w) { return Vec3f{w.x, w.y, -w.z}; };
  for (const Material& m : {translucent(plastic(kGrey, 0.3f)), translucent(diffuse(kGrey), 0.8f)}) {
    const LocalBsdf bsdf = local_bsdf(m);
    for (std::uint32_t i = 0; i < 200; ++i) {
      const auto [a, b] = directions(i);
      const double ab = brdf(bsdf, a, other_side(b)), ba = brdf(bsdf, b, other_side(a));
      EXPECT_NEAR(ab, ba, 1e-3 * (ab + 1e-3));
    }
  }
}

/// Rough glass, f(a, b)·η_b² = f(b, a)·η_a²: reflections on either side and refraction, further bounces,
/// films and dispersion included. @param ior of what is below, where light refracts into it
void expect_glass_reciprocal(const Material& m, double ior, int lane = 0) {
  const LocalBsdf bsdf = local_bsdf(m, lane);
  const auto index2 = [&](Vec3f w) { return w.z > 0.0f ? 1.0 : ior * ior; };
  int compared = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto [a, b] = directions(i);
    for (const auto& [wo, wi] : {std::pair{a, b}, {a, -b}, {-a, -b}}) {
      const double ab = brdf(bsdf, wo, wi) * index2(wi), ba = brdf(bsdf, wi, wo) * index2(wo);
      EXPECT_NEAR(ab, ba, 2e-3 * (ab + 1e-3)) << m.roughness << ' ' << wo.z << ' ' << wi.z;
      compared += ab > 1e-6;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Reciprocity, Glass) {
  const double flint = refractive_index(glass_index("SF11").value(), 450.0);
  for (float roughness : {0.3f, 0.6f, 1.0f}) {
    const Material solid = solid_glass(1.5f, roughness), thin = thin_glass(1.5f, roughness);
    expect_glass_reciprocal(solid, 1.5);
    expect_glass_reciprocal(solid_glass(2.4f, roughness), 2.4);
    expect_glass_reciprocal(thin, 1.0);
    expect_glass_reciprocal(dispersive(solid, "SF11"), flint);
    expect_glass_reciprocal(iridescent(thin, 400.0f), 1.0);
    expect_glass_reciprocal(iridescent(solid, 400.0f), 1.5);
    Material dimmed = solid;
    dimmed.specular = 0.4f;
    expect_glass_reciprocal(dimmed, 1.5);
  }
}

/// Under a coat of albedo A(wo) the base is dimmed by 1 − A(wo), seen from wo: no symmetric factor would
/// leave just the light that the coat lets through for a base that is glossy. What holds: but for that
/// factor, coat and base are reciprocal.
TEST(Reciprocity, CoatsButForTheirShare) {
  for (float roughness : {0.15f, 0.5f}) {
    const LocalBsdf whole = local_bsdf(coated(plastic(kGrey, 0.4f), roughness)),
                    coat = local_bsdf(coated(diffuse(ConstantSpectrum{0.0}), roughness));
    for (std::uint32_t i = 0; i < 20; ++i) {
      const auto [a, b] = directions(i);
      const double let_through_a = 1.0 - furnace(coat, a).albedo.mean,
                   let_through_b = 1.0 - furnace(coat, b).albedo.mean;
      const double ab = (brdf(whole, a, b) - brdf(coat, a, b)) / let_through_a,
                   ba = (brdf(whole, b, a) - brdf(coat, b, a)) / let_through_b;
      EXPECT_NEAR(ab, ba, 5e-3 * ab + 1e-3);
    }
  }
}

}  // namespace
}  // namespace photopic
