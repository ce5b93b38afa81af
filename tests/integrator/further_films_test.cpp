#include "core/further_films.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "integrator/integrator.h"
#include "spectral/observer.h"
#include "support/standard_scenes.h"
#include "support/statistics.h"

namespace photopic {
namespace {

using namespace test;

/// A bin's mean over the image and its error, from the pixels, each an estimate of its own.
Estimate bin_mean(const SpectralFilm& spectrum, const Film& film, int bin) {
  RunningMean mean;
  for (std::size_t i = 0; i < static_cast<std::size_t>(film.width() * film.height()); ++i)
    mean.add(spectrum.mean(film, i, bin));
  return mean.estimate();
}

/// The mean of `luminance`·lamp·factor over a bin, by fine steps.
double expected_bin(const TabulatedSpectrum& lamp, double luminance, const Spectrum& factor,
                    const SpectralFilm& spectrum, int bin) {
  constexpr int kSteps = 20000;
  const double unit = emission_xyz(lamp, Observer::cie1931()).y;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double lambda = spectrum.centre(bin) + spectrum.bin_width() * ((i + 0.5) / kSteps - 0.5);
    sum += lamp(lambda) * evaluate(factor, lambda);
  }
  return sum / kSteps * luminance / unit;
}

void expect_bins(const SpectralFilm& spectrum, const Film& film, const TabulatedSpectrum& lamp,
                 double luminance, const Spectrum& factor, const std::string& what) {
  const double threshold =
      normal_threshold(sidak_significance(0.01, 8 * static_cast<std::size_t>(spectrum.bins())));
  double total = 0.0, error = 0.0;
  for (int bin = 0; bin < spectrum.bins(); ++bin) {
    const double expected = expected_bin(lamp, luminance, factor, spectrum, bin);
    const Estimate seen = bin_mean(spectrum, film, bin);
    EXPECT_LT(std::abs(z_score(seen, {expected, 1e-4 * expected})), threshold)
        << what << ", " << spectrum.centre(bin) << " nm: " << seen.mean << " ± " << seen.error
        << ", expected " << expected;
    total += seen.mean, error += seen.error;
  }
  EXPECT_LT(error, 0.2 * total) << what;
}

/// A lamp seen directly, and a floor that mirrors its spectrum under a dome of it, with each sampler.
TEST(SpectralFilm, LampAndReflectanceTimesLamp) {
  const Spectrum paint = upsample_reflectance({0.6, 0.3, 0.1});
  const TabulatedSpectrum lamp = tabulate_emission(fl11());
  for (const bool reflected : {false, true}) {
    SceneBuilder b;
    if (reflected)
      b.floor({0, 0, 0}, 1, 1, b.material(metal(paint, 0.0f)));
    else
      b.floor({0, 0, 0}, 1, 1, b.lamp(fl11(), 7.0));
    if (reflected) b.ceiling({0, 0, 3}, 10, 10, b.lamp(fl11(), 7.0));
    b.camera({0, 0, 1}, {0, 0, 0}, 1, 8, 8);
    Scene source = b.build();
    if (reflected) source.materials[0].specular = 0.0f;
    const PreparedScene scene(std::move(source));
    for (const WavelengthSampler& s : all_samplers(scene_emission(scene))) {
      SpectralFilm spectrum(8, 8, 20);
      const RenderResult r =
          render(scene, s, {.spp = 2000, .seed = 5, .max_depth = 2, .further = {nullptr, &spectrum}});
      // Near normal incidence Schlick's term of a metal is below 1e-8.
      expect_bins(spectrum, r.film, lamp, 7.0, reflected ? paint : Spectrum(ConstantSpectrum{1.0}),
                  std::string(sampler_name(s)) + (reflected ? ", reflected" : ", lamp"));
    }
  }
}

/// Σ ȳ·L·Δλ / ∫ȳ dλ is the pixel's own Y, to the width of 1 nm.
TEST(SpectralFilm, SumsToTheImagesY) {
  for (const Observer* observer : {&Observer::cie1931(), &Observer::cie1964()}) {
    const PreparedScene scene(glossy_room(12).build());
    SpectralFilm spectrum(12, 12, 470);
    RenderOptions o{.spp = 64, .observer = observer};
    o.further.spectrum = &spectrum;
    const Film film = render(scene, UniformWavelengths{4}, o).film;
    for (std::size_t i = 0; i < 144; ++i) {
      double y = 0.0;
      for (int bin = 0; bin < 470; ++bin)
        y += (*observer)(spectrum.centre(bin)).y * spectrum.mean(film, i, bin) * spectrum.bin_width();
      EXPECT_NEAR(y / observer->y_integral(), film.mean(i).y, 0.01 * film.mean(i).y) << i;
    }
    EXPECT_GT(film.image_mean().y, 0.1);
  }
}

/// Dispersion leaves a path with one wavelength: the sum stays the image's Y.
TEST(SpectralFilm, SumsToYThroughDispersion) {
  Material flint = solid_glass(1.7f, 0.0f);
  flint.extensions.dispersion = glass_index("SF11");
  SceneBuilder b;
  b.sphere({0, 0, 0}, 1, 3, b.material(flint));
  b.ceiling({0, 0, 4}, 6, 6, b.lamp(d65(), 3.0, true));
  b.floor({0, 0, -3}, 6, 6, b.lamp(d65(), 2.0, true));
  b.camera({0, -5, 0}, {0, 0, 0}, 20, 6, 6);
  const PreparedScene scene(b.build());
  SpectralFilm spectrum(6, 6, 470);
  const RenderResult r = render(scene, UniformWavelengths{4}, {.spp = 512, .further = {nullptr, &spectrum}});
  EXPECT_GT(r.stats.split_paths, r.stats.paths / 10);
  double y = 0.0;
  for (std::size_t i = 0; i < 36; ++i)
    for (int bin = 0; bin < 470; ++bin)
      y += Observer::cie1931()(spectrum.centre(bin)).y * spectrum.mean(r.film, i, bin) / 36;
  EXPECT_NEAR(y / Observer::cie1931().y_integral(), r.film.image_mean().y, 2e-3 * r.film.image_mean().y);
}

/// The estimate from one render's samples against the spread of many renders: independent samples, so that it
/// is unbiased.
TEST(CovarianceFilm, PredictsTheSpreadOfOtherSeeds) {
  constexpr int kSeeds = 400;
  const Xyz weights{3.2406, -1.5372, -0.4986};  // red of sRGB, which covariances dominate
  const PreparedScene scene(diffuse_room(4).build());
  RunningMean predicted, mean, square;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    CovarianceFilm covariance(4, 4);
    const Film film =
        render(
            scene, UniformWavelengths{4},
            {.spp = 16, .sequence = Sequence::independent, .seed = seed, .further = {&covariance, nullptr}})
            .film;
    const Xyz m = film.mean(5);
    const double red = weights.x * m.x + weights.y * m.y + weights.z * m.z;
    predicted.add(covariance.variance_of_mean(film, 5, weights));
    mean.add(red), square.add(red * red);
  }
  const double m = mean.estimate().mean;
  const double spread = (square.estimate().mean - m * m) * kSeeds / (kSeeds - 1.0);
  // A variance from n values has the relative error √(2/n) where they are normal; sums of 16 nearly are.
  EXPECT_NEAR(predicted.estimate().mean / spread, 1.0, 4.0 * std::sqrt(2.0 / kSeeds));
  EXPECT_LT(predicted.estimate().error, 0.1 * spread);
}

TEST(CovarianceFilm, KnownNumbers) {
  Film film(2, 1);
  CovarianceFilm covariance(2, 1);
  for (const Xyz& s : {Xyz{1, 2, 0}, Xyz{2, 0, 5}, Xyz{6, 1, 1}}) film.add(1, s), covariance.add(1, s);
  // X + 2Y − Z of the samples: 5, −3, 7; squared deviations from their mean 3 sum to 56.
  EXPECT_NEAR(covariance.variance_of_mean(film, 1, {1, 2, -1}), 56.0 / 2 / 3, 1e-12);
  EXPECT_EQ(covariance.variance_of_mean(film, 0, {1, 2, -1}), 0.0);
}

/// Feeding them changes no bit of the film, and neither do threads and batches of them.
TEST(FurtherFilms, ThreadsAndBatchesChangeNoBit) {
  const PreparedScene scene(glass_room(18).build());
  const Film plain = render(scene, UniformWavelengths{4}, {.spp = 20}).film;
  std::vector<double> first;
  for (const int batch : {1024, 7})
    for (const std::size_t threads : {1u, 2u})
      for (const double target : {0.0, 0.001}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        SpectralFilm spectrum(18, 18, 31);
        CovarianceFilm covariance(18, 18);
        const Film film =
            render(
                scene, UniformWavelengths{4},
                {.spp = 20, .target_error = target, .batch_size = batch, .further = {&covariance, &spectrum}})
                .film;
        std::vector<double> values;
        for (std::size_t i = 0; i < 18 * 18; ++i) {
          for (int bin = 0; bin < 31; ++bin) values.push_back(spectrum.mean(film, i, bin));
          if (target > 0.0) continue;  // two films added up: other bits than one
          EXPECT_EQ(film.mean(i).y, plain.mean(i).y);
        }
        if (first.empty()) first = values;
        EXPECT_EQ(values, first) << batch << ", " << threads << ", " << target;
      }
}

}  // namespace
}  // namespace photopic
