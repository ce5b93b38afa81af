#include "support/render_checks.h"

#include <gtest/gtest.h>

namespace photopic::test {

Film render_finite(const PreparedScene& scene, int spp, int max_depth, std::uint32_t seed) {
  const IlluminantWavelengths sampler{4, base_density(scene_emission(scene))};
  RenderResult r = render(
      scene, sampler, {.spp = spp, .sequence = Sequence::independent, .seed = seed, .max_depth = max_depth});
  EXPECT_EQ(r.stats.non_finite, 0u);
  return std::move(r.film);
}

Film render_finite(const SceneBuilder& builder, int spp, int max_depth, std::uint32_t seed) {
  return render_finite(PreparedScene(builder.build()), spp, max_depth, seed);
}

Estimate luminance(const Film& film) {
  return image_estimates(film)[1];
}

void expect_same_image(const Film& a, const Film& b, std::size_t tests, const std::string& what) {
  const std::vector<Estimate> p = quarter_estimates(a), q = quarter_estimates(b);
  EXPECT_LT(largest_z(p, q), normal_threshold(sidak_significance(0.01, tests * p.size())))
      << what << ": Y " << p[1].mean << " ± " << p[1].error << " and " << q[1].mean << " ± " << q[1].error;
}

void expect_luminance(const Film& film, double expected, const std::string& what, double tolerance) {
  const Estimate e = luminance(film);
  EXPECT_NEAR(e.mean, expected, 4.5 * e.error + tolerance * expected) << what << ", error " << e.error;
  EXPECT_LT(e.error, 0.02 * expected) << what;
}

}  // namespace photopic::test
