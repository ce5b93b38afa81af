#pragma once

#include "integrator/integrator.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic::test {

/// Renders with independent numbers and the scene's illuminant sampler, expecting every sample to be finite.
Film render_finite(const PreparedScene& scene, int spp, int max_depth = 12, std::uint32_t seed = 1);
Film render_finite(const SceneBuilder& builder, int spp, int max_depth = 12, std::uint32_t seed = 1);

/// The image's mean Y.
Estimate luminance(const Film& film);

/// Expects the two films' means and quarters to agree within their error bars (family significance 1 % over
/// `tests` such comparisons).
void expect_same_image(const Film& a, const Film& b, std::size_t tests, const std::string& what);

/// Expects a mean Y within 4.5 standard errors and a relative tolerance, its error below 2 %.
void expect_luminance(const Film& film, double expected, const std::string& what, double tolerance = 3e-4);

}  // namespace photopic::test
