#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <functional>

#include "integrator/integrator.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

bool same_bits(const Film& a, const Film& b) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.width() * a.height()); ++i) {
    const Xyz p = a.mean(i), q = b.mean(i), v = a.variance_of_mean(i), w = b.variance_of_mean(i);
    if (p.x != q.x || p.y != q.y || p.z != q.z || v.x != w.x || v.y != w.y || v.z != w.z) return false;
  }
  return true;
}

/// Which of two surfaces in exactly one place a ray meets, Embree decides by the rays beside it: those of a
/// batch, which are the same whatever the threads. Boxes share the plane of their fronts: batches of one path
/// give other bits here.
TEST(Determinism, ThreadsChangeNoBitWhereSurfacesCoincide) {
  SceneBuilder b = lamp_room(fl11(), 32);
  for (int i = 0; i < 24; ++i) {
    const double x = -0.8 + 0.06 * i;
    b.box({x, 0.2, 0.05 * (i % 5)}, {x + 0.31, 0.5 + 0.02 * i, 1.2},
          b.material(diffuse(ConstantSpectrum{0.04 * i})));
  }
  const PreparedScene scene(b.build());
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return render(scene, UniformWavelengths{4}, {.spp = 20}).film;
  };
  EXPECT_TRUE(same_bits(with(1), with(2)));
}

TEST(Determinism, BatchesAndThreadsChangeNoBit) {
  for (const SceneBuilder& b : {glossy_room(20), glass_room(20)}) {
    const PreparedScene scene(b.build());
    for (Sequence sequence : {Sequence::sobol, Sequence::independent}) {
      const RenderOptions reference{.spp = 20, .sequence = sequence, .seed = 7};
      const RenderResult a = render(scene, UniformWavelengths{4}, reference);
      for (int batch : {1, 100, 333, 4096})
        for (std::size_t threads : {1u, 2u}) {
          const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
          RenderOptions o = reference;
          o.batch_size = batch;
          const RenderResult r = render(scene, UniformWavelengths{4}, o);
          EXPECT_TRUE(same_bits(a.film, r.film)) << "batch " << batch << ", threads " << threads;
          EXPECT_EQ(a.stats.rays, r.stats.rays);
          EXPECT_EQ(a.stats.shadow_rays, r.stats.shadow_rays);
        }
      RenderOptions other = reference;
      other.seed = 8;
      EXPECT_FALSE(same_bits(a.film, render(scene, UniformWavelengths{4}, other).film));
    }
  }
}

/// A window's pixels have the whole picture's samples, and the others none.
TEST(Determinism, WindowsChangeNoBit) {
  for (const SceneBuilder& b : {glossy_room(40), glass_room(40)}) {
    const PreparedScene scene(b.build());
    const Film whole = render(scene, UniformWavelengths{4}, {.spp = 20, .seed = 7}).film;
    for (const PixelWindow& window : {PixelWindow{13, 5, 37, 18}, {0, 39, 40, 40}, {16, 16, 17, 17}}) {
      const RenderResult r = render(scene, UniformWavelengths{4}, {.spp = 20, .seed = 7, .window = window});
      EXPECT_EQ(r.stats.paths, 20u * static_cast<unsigned>(window.pixel_count()));
      EXPECT_TRUE(same_bits(r.film.cropped(window), whole.cropped(window)));
      std::uint64_t samples = 0;
      for (std::size_t i = 0; i < 1600; ++i) samples += r.film.count(i);
      EXPECT_EQ(samples, r.stats.paths);
    }
  }
}

/// More samples continue the same sequence: the first ones stay.
TEST(Determinism, SamplesDoNotDependOnTheirNumber) {
  const PreparedScene scene(diffuse_room(8).build());
  const RenderResult few = render(scene, UniformWavelengths{4}, {.spp = 1}),
                     more = render(scene, UniformWavelengths{4}, {.spp = 2});
  // Two samples a and b: mean m, variance of the mean v = (a − b)²/4, so a is m ± √v.
  for (std::size_t i = 0; i < 64; ++i) {
    const double a = few.film.mean(i).y, m = more.film.mean(i).y,
                 s = std::sqrt(more.film.variance_of_mean(i).y);
    EXPECT_NEAR(std::min(std::abs(a - m - s), std::abs(a - m + s)), 0.0, 1e-6 * (1.0 + std::abs(a)));
  }
}

TEST(Determinism, WavelengthCountsAgree) {
  const PreparedScene scene(glossy_room(16).build());
  const TabulatedSpectrum emission = scene_emission(scene);
  const int counts[] = {1, 4, 8, 16};
  std::vector<std::vector<Estimate>> seen;
  for (int i = 0; i < 4; ++i)
    for (const WavelengthSampler& s :
         {WavelengthSampler(UniformWavelengths{counts[i]}),
          WavelengthSampler(IlluminantWavelengths{counts[i], base_density(emission)})}) {
      const RenderResult r = render(scene, s,
                                    {.spp = 300,
                                     .sequence = Sequence::independent,
                                     .seed = static_cast<std::uint32_t>(seen.size()),
                                     .max_depth = 6});
      seen.push_back(quarter_estimates(r.film));
    }
  const double threshold = normal_threshold(sidak_significance(0.01, 7 * seen[0].size()));
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_LT(largest_z(seen[0], seen[i]), threshold) << i;
  EXPECT_LT(seen.back()[1].error, 0.01 * seen.back()[1].mean);
}

TEST(Determinism, OtherWavelengthCountsAreRefused) {
  const PreparedScene scene(diffuse_room(4).build());
  for (int count : {2, 3, 5, 32})
    EXPECT_THROW(render(scene, UniformWavelengths{count}, {.spp = 1}), std::invalid_argument) << count;
}

TEST(Render, CountsWhatItDid) {
  const PreparedScene scene(diffuse_room(10).build());
  const RenderResult r = render(scene, UniformWavelengths{4}, {.spp = 5, .max_depth = 3});
  EXPECT_EQ(r.stats.paths, 500u);
  EXPECT_LE(r.stats.rays, 1500u);
  EXPECT_GE(r.stats.rays, 500u);
  EXPECT_LE(r.stats.shadow_rays, 1000u);
  EXPECT_FALSE(r.stats.stopped);
}

TEST(Render, StopsWhenAsked) {
  const PreparedScene scene(diffuse_room(10).build());
  const std::atomic<bool> stop{true};
  RenderOptions o{.spp = 5};
  o.stop = &stop;
  const RenderResult r = render(scene, UniformWavelengths{4}, o);
  EXPECT_TRUE(r.stats.stopped);
  EXPECT_EQ(r.stats.paths, 0u);
}

/// A lamp whose luminance is infinite spoils samples: they are counted, and the film stays finite.
TEST(Render, NonFiniteSamplesAreCountedAndLeftOut) {
  SceneBuilder b;
  const auto lamp = b.lamp(d65(), 1.0);
  b.floor({0, 0, 0}, 0.5, 10, lamp);
  b.camera({0, 0, 1}, {0, 0, 0}, 90, 8, 8);
  Scene source = b.build();
  source.materials[lamp].emission_luminance = std::numeric_limits<float>::infinity();
  const PreparedScene scene(std::move(source));
  for (const RenderResult& r : {render(scene, UniformWavelengths{4}, {.spp = 4, .max_depth = 1}),
                                render_naive(scene, UniformWavelengths{4}, {.spp = 4, .max_depth = 1})}) {
    EXPECT_GT(r.stats.non_finite, 64u);
    EXPECT_LT(r.stats.non_finite, 192u);
    EXPECT_TRUE(std::isfinite(r.film.image_mean().y));
  }
}

/// What a scene can do to spoil samples, and what is named as the cause; looking for it changes no count.
TEST(Render, NonFiniteSamplesHaveACause) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  struct Spoilt {
    std::function<void(Scene&)> how;
    NonFiniteCause cause;
  };
  const Spoilt cases[] = {
      {[](Scene& s) { s.materials[0].emission_luminance = kInfinity; }, NonFiniteCause::light_sample},
      {[](Scene& s) { s.materials[2].emission_luminance = kInfinity; }, NonFiniteCause::emission},
      {[](Scene& s) { s.materials[1].base_color = ConstantSpectrum{kInfinity}; }, NonFiniteCause::scattering},
      {[](Scene& s) { s.camera.position.x = NAN; }, NonFiniteCause::camera},
      {[](Scene& s) {
         s.camera.position.x = NAN;  // leaves the scene, whose environment is not asked for that direction
         Environment sky(Image(1000, 2), 0.0);
         sky.emission_spectrum = 0;
         s.environment = std::make_shared<const Environment>(std::move(sky));
       },
       NonFiniteCause::camera},
      {[](Scene& s) { s.camera.position.x = 1e30f; }, NonFiniteCause::camera},
      {[](Scene& s) { s.emission_spectra[0] = s.emission_spectra[0].scaled(1e200); },
       NonFiniteCause::wavelengths},
  };
  for (const Spoilt& spoilt : cases) {
    SceneBuilder b;
    b.ceiling({0, 0, 2}, 0.5, 0.5, b.lamp(d65(), 1.0));
    b.floor({0, 0, 0}, 1, 1, b.material(diffuse(ConstantSpectrum{0.5})));
    b.floor({0, 0.5, 0.1}, 0.3, 0.3, b.lamp(d65(), 1.0));
    b.camera({0, 0, 1}, {0, 0, 0}, 90, 8, 8);
    const PreparedScene sound(b.build());
    const RenderOptions o{.spp = 4, .max_depth = 2};
    Scene scene = b.build();
    spoilt.how(scene);
    const PreparedScene prepared(std::move(scene));
    const RenderStats stats = render(prepared, UniformWavelengths{4}, o).stats;
    EXPECT_GT(render_naive(prepared, UniformWavelengths{4}, o).stats.non_finite, 0u);
    EXPECT_GT(stats.non_finite_causes[spoilt.cause], 0u);
    EXPECT_EQ(stats.non_finite_causes.total(), stats.non_finite);
    EXPECT_EQ(stats.paths, render(sound, UniformWavelengths{4}, o).stats.paths);
  }
}

}  // namespace
}  // namespace photopic
