#include <gtest/gtest.h>

#include "core/gltf_loader.h"
#include "integrator/integrator.h"
#include "optimize/solver.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

/// The optimiser's densities for two lamps together, found in no time.
WavelengthSampler optimized_for(const PreparedScene& scene) {
  OptimizeOptions options;
  options.effort = Effort::quick;
  return OptimizedWavelengths(optimize_distribution(scene_lamps(scene), options).distribution);
}

/// All samplers see the same light, whole and by quarters: each is held against the oracle's uniform one.
TEST(TwoLamps, EverySamplerHasTheSameMean) {
  const PreparedScene scene(load_gltf(PHOTOPIC_SCENES "/two-lamps/scene.gltf", {.width = 16, .height = 16}));
  ASSERT_EQ(scene_lamps(scene).size(), 2u);
  RenderOptions o{.spp = 12000, .sequence = Sequence::independent, .seed = 1, .max_depth = 6};
  const std::vector<Estimate> oracle = quarter_estimates(render_naive(scene, UniformWavelengths{4}, o).film);

  EXPECT_LT(oracle[1].error, 0.005 * oracle[1].mean);

  const TabulatedSpectrum light = scene_emission(scene);
  const std::vector<WavelengthSampler> samplers{UniformWavelengths{4}, VisibleWavelengths{4},
                                                IlluminantWavelengths{4, base_density(light)},
                                                optimized_for(scene)};
  o.spp = 7000;
  for (const WavelengthSampler& sampler : samplers) {
    ++o.seed;
    const RenderResult result = render(scene, sampler, o);
    const std::vector<Estimate> found = quarter_estimates(result.film);
    EXPECT_LT(found[1].error, 0.005 * found[1].mean) << sampler_name(sampler);
    EXPECT_LT(largest_z(found, oracle),
              normal_threshold(sidak_significance(0.01, samplers.size() * found.size())))
        << sampler_name(sampler) << ": Y " << found[1].mean << " ± " << found[1].error << ", oracle "
        << oracle[1].mean << " ± " << oracle[1].error;
    EXPECT_EQ(result.stats.non_finite, 0u);
  }
}

}  // namespace
}  // namespace photopic
