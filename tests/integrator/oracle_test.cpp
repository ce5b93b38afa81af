#include <gtest/gtest.h>

#include <cmath>

#include "integrator/integrator.h"
#include "integrator/vertex.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

/// render() and the oracle estimate the same integral: every channel of the image and of its quarters agrees
/// within its error bars, and these are at most 0.5 % of the image's Y.
void compare_with_oracle(const SceneBuilder& builder, int max_depth, int spp, int naive_spp) {
  const PreparedScene scene(builder.build());
  std::uint32_t seed = 100;
  for (const WavelengthSampler& s : all_samplers(scene_emission(scene))) {
    RenderOptions o{.spp = spp, .sequence = Sequence::independent, .seed = ++seed, .max_depth = max_depth};
    const RenderResult clever = render(scene, s, o);
    o.spp = naive_spp, o.seed = ++seed;
    const RenderResult simple = render_naive(scene, s, o);
    const std::vector<Estimate> a = quarter_estimates(clever.film), b = quarter_estimates(simple.film);
    const std::string name(sampler_name(s));
    for (const Estimate& e : {a[1], b[1]}) EXPECT_LT(e.error, 0.005 * e.mean) << name;
    // Three rooms, four samplers, fifteen estimates each.
    EXPECT_LT(largest_z(a, b), normal_threshold(sidak_significance(0.01, 3 * 4 * a.size())))
        << name << ": Y " << a[1].mean << " ± " << a[1].error << ", oracle " << b[1].mean << " ± "
        << b[1].error;
    ::testing::Test::RecordProperty(name, std::to_string(100 * a[1].error / a[1].mean) + " " +
                                              std::to_string(100 * b[1].error / b[1].mean));
    EXPECT_EQ(clever.stats.non_finite + simple.stats.non_finite, 0u);
  }
}

TEST(Oracle, DiffuseRoom) {
  compare_with_oracle(diffuse_room(), 6, 900, 1300);
}
TEST(Oracle, GlossyRoom) {
  compare_with_oracle(glossy_room(), 6, 900, 1300);
}
TEST(Oracle, GlassRoom) {
  compare_with_oracle(glass_room(), 8, 1000, 1500);
}

/// A BSDF that has lost its way.
struct LostBsdf {
  static constexpr bool kTwoSided = true;
  LostBsdf(const ShadingMaterial<4>&, Vec3f) {}
  std::optional<BsdfSample<4>> sample(float, Sample2d) const {
    const float nan = std::nanf("");
    return BsdfSample<4>{{nan, nan, nan}, SampledSpectrum<4>(1.0f), 1.0f, false};
  }
};

/// A direction that is not a number goes on, to be counted where its ray cannot be traced.
TEST(Oracle, LostDirectionsAreNotHidden) {
  const PreparedScene scene(diffuse_room().build());
  const Ray down{{0, 0, 1}, {0.1f, 0.2f, -1}};
  const Hit hit = scene.accel.intersect(down);
  ASSERT_NE(hit.shape, kNoHit);
  const Vertex<4, LostBsdf> vertex(scene, hit, -down.direction, SampledSpectrum<4>(550.0f),
                                   SampledSpectrum<4>(1.0f));
  const auto lost = vertex.sample(0.5f, {0.5f, 0.5f});
  ASSERT_TRUE(lost);
  EXPECT_FALSE(is_traceable(Ray{down.origin, lost->wi}));
}

/// The stratified sequence estimates it too: the mean over seeds, its error from their scatter.
TEST(Oracle, SobolSequenceIsUnbiased) {
  const PreparedScene scene(glass_room(8).build());
  const WavelengthSampler sampler = arbitrary_distribution(scene_emission(scene));
  RunningMean sobol[3];
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    const Xyz m = render(scene, sampler, {.spp = 64, .seed = seed, .max_depth = 8}).film.image_mean();
    sobol[0].add(m.x), sobol[1].add(m.y), sobol[2].add(m.z);
  }
  const RenderResult independent =
      render(scene, sampler, {.spp = 3000, .sequence = Sequence::independent, .seed = 77, .max_depth = 8});
  const std::vector<Estimate> expected = image_estimates(independent.film);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(std::abs(z_score(sobol[i].estimate(), expected[i])), 4.0)
        << i << ": " << sobol[i].estimate().mean << " ± " << sobol[i].estimate().error << ", independent "
        << expected[i].mean << " ± " << expected[i].error;
}

/// Light samples that cross an absorbing medium: a lamp and a diffuse ball inside rough, tinted glass.
TEST(Oracle, LampInsideAbsorbingGlass) {
  SceneBuilder b;
  Material glass = solid_glass(1.3f, 0.5f);
  glass.attenuation_color = upsample_reflectance({0.7, 0.3, 0.1});
  glass.attenuation_distance = 0.5f;
  b.box({-1, -1, -1}, {1, 1, 1}, b.material(glass));
  b.box({-0.8, -0.5, -0.5}, {-0.2, 0.5, 0.5}, b.lamp(d65(), 5.0));
  b.sphere({0.5, 0, 0}, 0.4, 2, b.material(diffuse(ConstantSpectrum{0.8})));
  b.camera({0.5, -3, 1}, {0, 0, 0}, 40, 16, 16);
  const PreparedScene scene(b.build());
  RenderOptions o{.spp = 500, .sequence = Sequence::independent, .seed = 1, .max_depth = 8};
  const RenderResult clever = render(scene, UniformWavelengths{4}, o);
  o.seed = 2;
  const std::vector<Estimate> a = quarter_estimates(clever.film),
                              c = quarter_estimates(render_naive(scene, UniformWavelengths{4}, o).film);
  EXPECT_LT(a[1].error, 0.01 * a[1].mean);
  EXPECT_LT(largest_z(a, c), normal_threshold(sidak_significance(0.01, a.size())))
      << a[1].mean << " ± " << a[1].error << ", oracle " << c[1].mean << " ± " << c[1].error;
}

/// Roulette and the depth limit: a limit beyond all roulette changes nothing but noise.
TEST(Oracle, RouletteIsUnbiased) {
  SceneBuilder b = lamp_room(d65());
  const PreparedScene scene(b.build());
  RenderOptions o{.spp = 400, .sequence = Sequence::independent, .seed = 1, .max_depth = 64};
  const RenderResult clever = render(scene, UniformWavelengths{4}, o);
  o.seed = 2, o.spp = 600, o.max_depth = 40;  // 0.7⁴⁰ is 6e-7
  const RenderResult simple = render_naive(scene, UniformWavelengths{4}, o);
  const std::vector<Estimate> a = quarter_estimates(clever.film), c = quarter_estimates(simple.film);
  EXPECT_LT(largest_z(a, c), normal_threshold(sidak_significance(0.01, a.size())))
      << a[1].mean << " ± " << a[1].error << ", oracle " << c[1].mean << " ± " << c[1].error;
}

}  // namespace
}  // namespace photopic
