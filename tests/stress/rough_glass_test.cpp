#include <gtest/gtest.h>

#include "core/bsdf/albedo_axes.h"
#include "core/bsdf/glass_albedo.h"
#include "core/sample_sequence.h"
#include "support/bsdf_checks.h"
#include "support/scene_builder.h"

namespace photopic {
namespace {

using namespace test;

/// Almost no change of index is almost no surface: what rough glass scatters tends to what passes straight
/// on.
TEST(RoughGlass, TendsToAir) {
  for (float ior : {1.0001f, 1.001f, 1.01f})
    for (double cos_theta : {0.9, -0.9}) {
      const LocalBsdf glass = local_bsdf(solid_glass(ior, 0.2f));
      const Vec3f wo = direction(cos_theta);
      Vec3d mean{};
      for (std::uint32_t i = 0; i < 256; ++i) {
        const SampleStream stream(Sequence::sobol, 0, 0, i);
        const auto s = glass.sample(wo, stream.get_1d(0), stream.get_2d(1));
        if (s) mean = mean + to_double(s->wi) * (s->weight / 256);
      }
      EXPECT_LT(length(mean + to_double(wo)), 3.0 * (ior - 1.0f) + 2e-3) << ior << ' ' << cos_theta;
    }
}

struct Interface {
  Estimate kept;  ///< of light from all around on one side: the share that goes on
  double passed;  ///< the share that leaves through it
};

/// Seen from inside glass that is lit evenly: directions go by the cosine. All normals are sampled from each
/// of them, for an error far below that of as many directions.
Interface from_inside(const LocalBsdf& glass, double ior) {
  constexpr std::uint32_t kSequences = 8, kNormals = 2048;
  constexpr int kHeights = 32, kLobes = 8;
  RunningMean kept, passed;
  for (std::uint32_t seed = 0; seed < kSequences; ++seed) {
    double sum = 0.0, through = 0.0;
    for (int height = 0; height < kHeights; ++height) {
      const double mu2 = (height + (seed + 0.5) / kSequences) / kHeights;
      for (std::uint32_t i = 0; i < kNormals; ++i) {
        const SampleStream stream(Sequence::sobol, kSequences * static_cast<std::uint32_t>(height) + seed, 0,
                                  i);
        for (int lobe = 0; lobe < kLobes; ++lobe) {
          const float u_lobe = (stream.get_1d(0) + static_cast<float>(lobe)) / kLobes;
          const auto s =
              glass.sample(direction(-std::sqrt(mu2)), std::min(u_lobe, 0x1.fffffep-1f), stream.get_2d(1));
          if (!s) continue;
          const bool crosses = s->wi.z > 0.0f;
          const double weight = crosses ? s->weight / (ior * ior) : s->weight;
          sum += weight, through += crosses ? weight : 0.0;
        }
      }
    }
    constexpr double kSamples = double{kHeights} * kNormals * kLobes;
    kept.add(sum / kSamples), passed.add(through / kSamples);
  }
  return {kept.estimate(), passed.estimate().mean};
}

/// The table of a texture's roughnesses tells what one roughness's own does.
TEST(RoughGlass, AnyRoughnessIsLikeOne) {
  for (float ior : {1.5f, 4.0f}) {
    const GlassAlbedo all({ior}, {kSmoothRoughness, 1.0f});
    for (float roughness : {0.034f, 0.05f, 0.09f, 0.14f, 0.35f, 0.77f, 0.96f}) {
      const GlassAlbedo one({ior}, {roughness, roughness});
      for (float eta : {ior, 1.0f / ior})
        for (float mu : {0.003f, 0.01f, 0.03f, 0.1f, 0.3f, 0.7f, 1.0f})
          EXPECT_NEAR(all.missing(mu, roughness, eta, {}), one.missing(mu, roughness, eta, {}), 0.005)
              << ior << ' ' << roughness << ' ' << eta << ' ' << mu;
    }
  }
}

/// Light bounces many times within very rough glass of high index, 26 times in the mean where the index is 4,
/// and what is lost at each adds up: of all that enters a closed body 0.5 % at most. In a furnace it is lit
/// evenly within, so one bounce tells of all.
TEST(RoughGlass, KeepsLightThroughManyInterfaces) {
  for (float ior : {1.5f, 2.4f, 3.0f, 4.0f})
    for (float roughness : {0.1f, 0.4f, 0.7f, 1.0f}) {
      const Interface inside = from_inside(local_bsdf(solid_glass(ior, roughness)), ior);
      const double bounces = 1.0 / inside.passed;
      EXPECT_NEAR(bounces * (inside.kept.mean - 1.0), 0.0, 0.005) << ior << " roughness " << roughness;
      EXPECT_LT(bounces * inside.kept.error, 0.002) << ior << " roughness " << roughness;
    }
}

}  // namespace
}  // namespace photopic
