#include "core/bsdf/grain_albedo.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/bsdf/spectral_fresnel.h"
#include "core/sample_sequence.h"

namespace photopic {
namespace {

using Weights = FresnelAlbedo::Weights;

struct Brushed {
  AnisotropicGgx ggx;
  SampleStream stream;
};
Brushed surface(std::uint32_t i) {
  const SampleStream stream(Sequence::sobol, 3, 0, i);
  const Sample2d u = stream.get_2d(0);
  return {AnisotropicGgx::of(std::max(u.x, 0.032f), u.y), stream};
}
Vec3f direction(Sample2d u) {
  const float z = std::max(u.x * u.x * u.x, 1e-4f), r = std::sqrt(1.0f - z * z);
  const SinCos phi = sin_cos_two_pi(u.y);
  return {r * phi.cos, r * phi.sin, z};
}

/// Reflectances of films on dielectrics, thin to thick, of paths of four wavelengths; 1 at grazing incidence.
std::vector<FresnelFit<4>> films() {
  std::vector<FresnelFit<4>> all;
  for (float base : {1.5f, 4.0f})
    for (float film : {1.3f, 1.8f, 2.4f})
      for (float thickness : {120.0f, 250.0f, 400.0f, 1000.0f, 2000.0f}) {
        const SampledSpectrum<4> f0(sqr((base - 1.0f) / (base + 1.0f))), f90(1.0f);
        auto fresnel = SpectralFresnel<4>::schlick(f0, f90);
        SurfaceFilm<4> on_top{1.0f, film};
        for (int j = 0; j < 4; ++j)
          on_top.phase.v[j] = 2.0f * kPi * thickness / (400.0f + 60.0f * static_cast<float>(j));
        fresnel.put_on(on_top);
        all.emplace_back(fresnel);
      }
  return all;
}

/// The table tells within 0.5 % what integration of 16,384 points does, of whatever lies on the surface.
TEST(GrainAlbedo, TableIsTheIntegral) {
  const VisibleNormals normals(16384);
  const std::vector<FresnelFit<4>> fits = films();
  for (std::uint32_t i = 0; i < 256; ++i) {
    const auto [ggx, stream] = surface(i);
    for (std::uint32_t k = 1; k < 5; ++k) {
      const Vec3f wo = direction(stream.get_2d(k));
      const Weights exact = FresnelAlbedo::integrate(normals, ggx, wo),
                    table = GrainAlbedo(ggx).directional(wo, true);
      const auto where = [&] { return fmt::format("{} {} {} {}", ggx.alpha_x, ggx.alpha_y, wo.x, wo.z); };
      for (float Weights::*part : {&Weights::missing, &Weights::f90, &Weights::f0})
        EXPECT_NEAR(table.*part, exact.*part, 0.005) << where();
      for (const FresnelFit<4>& fit : fits) {
        const SampledSpectrum<4> a = fit.albedo(table), b = fit.albedo(exact);
        for (int j = 0; j < 4; ++j) EXPECT_NEAR(a[j], b[j], 0.005) << where();
      }
    }
  }
}

/// The average is that of what the table says of directions.
TEST(GrainAlbedo, AverageIsTheTablesOwn) {
  constexpr std::uint32_t kDirections = 8192;
  for (std::uint32_t i = 0; i < 16; ++i) {
    const AnisotropicGgx ggx = surface(i).ggx;
    const GrainAlbedo albedo(ggx);
    Weights sum;
    for (std::uint32_t k = 0; k < kDirections; ++k) {  // μ = x⁴, 2μ dμ = 8x⁷ dx
      const Sample2d u = SampleStream(Sequence::sobol, 4, 0, k).get_2d(0);
      const float z = sqr(sqr(u.x)), r = std::sqrt(1.0f - z * z);
      const SinCos phi = sin_cos_two_pi(u.y);
      sum.add(albedo.directional({r * phi.cos, r * phi.sin, z}, true),
              8.0f * z * u.x * u.x * u.x / kDirections);
    }
    const Weights average = albedo.average();
    const std::string where = fmt::format("{} {}", ggx.alpha_x, ggx.alpha_y);
    EXPECT_NEAR(average.missing / sum.missing, 1.0, 0.01) << where;
    EXPECT_NEAR(average.f90, sum.f90, 0.0005) << where;
    for (std::size_t k = 0; k < FresnelAlbedo::kNodes; ++k)
      EXPECT_NEAR(average.rest[k], sum.rest[k], 0.0005) << where << " node " << k;
  }
}

}  // namespace
}  // namespace photopic
