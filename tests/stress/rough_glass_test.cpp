#include <gtest/gtest.h>

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

}  // namespace
}  // namespace photopic
