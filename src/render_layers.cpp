#include "render_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "error.h"
#include "integrator/first_hits.h"
#include "interrupt.h"
#include "scene_setup.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

/// Of spectra. A sum takes 8 bytes; while the file is put together 4 more.
constexpr double kMostBytes = 24e9, kBytesOfSum = 12;

bool asks_for(const RenderArguments& arguments, const char* aov) {
  return std::ranges::find(arguments.aovs, aov) != arguments.aovs.end();
}

std::vector<std::string> channels(const std::string& layer, const char* letters) {
  std::vector<std::string> names;
  for (const char* c = letters; *c != '\0'; ++c) names.push_back(layer + '.' + *c);
  return names;
}

/// @param hits keeps the image alive
ImageLayer image_layer(const std::string& name, const char* letters,
                       const std::shared_ptr<const FirstHits>& hits, Image FirstHits::*image) {
  return {channels(name, letters), {}, [hits, image](std::size_t pixel, std::span<float> values) {
            std::copy_n(&((*hits).*image).pixels[3 * pixel], 3, values.begin());
          }};
}

/// @param hits keeps the values alive
ImageLayer number_layer(const std::string& name, const char* letter,
                        const std::shared_ptr<const FirstHits>& hits,
                        std::vector<float> FirstHits::*numbers) {
  return {channels(name, letter), {}, [hits, numbers](std::size_t pixel, std::span<float> values) {
            values[0] = ((*hits).*numbers)[pixel];
          }};
}

void add_first_hits(const RenderArguments& arguments, const PreparedScene& scene, const Film& film,
                    std::vector<ImageLayer>& layers) {
  const bool albedo = asks_for(arguments, "albedo"), normal = asks_for(arguments, "normal"),
             depth = asks_for(arguments, "depth"), alpha = asks_for(arguments, "alpha");
  if (!albedo && !normal && !depth && !alpha) return;
  const SceneArguments& options = arguments.scene;
  const auto hits = std::make_shared<const FirstHits>(
      first_hits(scene, film, sequence_of(options), options.seed, interrupt_flag()));
  if (albedo) {
    layers.push_back(image_layer("albedo", "RGB", hits, &FirstHits::albedo));
    layers.back().metadata["albedo"] = "linear sRGB";  // whatever the picture's own
  }
  if (normal) layers.push_back(image_layer("normal", "XYZ", hits, &FirstHits::normal));
  if (depth) layers.push_back(number_layer("depth", "Z", hits, &FirstHits::depth));
  if (alpha) layers.push_back(number_layer("alpha", "A", hits, &FirstHits::alpha));
}

/// What X, Y and Z weigh in each channel of a picture.
std::array<Xyz, 3> channel_weights(bool xyz, const ChromaticAdaptation& adaptation) {
  if (xyz) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Rgb x = xyz_to_linear_srgb(adaptation({1, 0, 0})), y = xyz_to_linear_srgb(adaptation({0, 1, 0})),
            z = xyz_to_linear_srgb(adaptation({0, 0, 1}));
  return {{{x.r, y.r, z.r}, {x.g, y.g, z.g}, {x.b, y.b, z.b}}};
}

ImageLayer variance_layer(bool xyz, const Film& film, const CovarianceFilm& covariance,
                          const ChromaticAdaptation& adaptation) {
  const auto weights = channel_weights(xyz, adaptation);
  return {channels("variance", xyz ? "XYZ" : "RGB"),
          {},
          [&film, &covariance, weights](std::size_t pixel, std::span<float> values) {
            for (std::size_t c = 0; c < 3; ++c)
              values[c] = static_cast<float>(covariance.variance_of_mean(film, pixel, weights[c]));
          }};
}

/// Fichet, Pacanowski, Wilkie 2021: An OpenEXR Layout for Spectral Images. Radiance is per nm, as in pbrt.
ImageLayer spectral_layer(const Film& film, const SpectralFilm& spectrum) {
  std::vector<std::string> names;
  for (int bin = 0; bin < spectrum.bins(); ++bin) {
    std::string centre = fmt::format("{:.6f}", spectrum.centre(bin));
    std::ranges::replace(centre, '.', ',');
    names.push_back("S0." + centre + "nm");
  }
  const double luminance =
      kMaximalEfficacy * Observer::cie1931().y_integral();  // where spectral radiance is 1
  return {std::move(names),
          {{"spectralLayoutVersion", "1.0"}, {"emissiveUnits", "W.m^-2.sr^-1"}},
          [&film, &spectrum, luminance](std::size_t pixel, std::span<float> values) {
            for (int bin = 0; bin < spectrum.bins(); ++bin)
              values[static_cast<std::size_t>(bin)] =
                  static_cast<float>(spectrum.mean(film, pixel, bin) / luminance);
          }};
}

void check_memory(const RenderArguments& arguments, const Camera& camera) {
  const double bytes = kBytesOfSum * arguments.spectral_bins * camera.width * camera.height;
  if (bytes > kMostBytes)
    throw InputError(fmt::format("--spectral-bins {}", arguments.spectral_bins),
                     fmt::format("would take {:.0f} GB at {}x{}", 1e-9 * bytes, camera.width, camera.height),
                     "ask for fewer bins or pixels");
}

}  // namespace

LayerFilms::LayerFilms(const RenderArguments& arguments, const Camera& camera) {
  if (asks_for(arguments, "variance")) covariance.emplace(camera.width, camera.height);
  if (arguments.spectral_bins == 0) return;
  check_memory(arguments, camera);
  spectrum.emplace(camera.width, camera.height, arguments.spectral_bins);
}

FurtherFilms LayerFilms::to_feed() {
  return {covariance ? &*covariance : nullptr, spectrum ? &*spectrum : nullptr};
}

std::vector<ImageLayer> make_layers(const RenderArguments& arguments, const PreparedScene& scene,
                                    const Film& film, const LayerFilms& films,
                                    const ChromaticAdaptation& adaptation) {
  std::vector<ImageLayer> layers;
  add_first_hits(arguments, scene, film, layers);
  if (asks_for(arguments, "samples"))
    layers.push_back({channels("samples", "Y"), {}, [&film](std::size_t pixel, std::span<float> values) {
                        values[0] = static_cast<float>(film.count(pixel));
                      }});
  if (films.covariance)
    layers.push_back(variance_layer(arguments.color == "xyz", film, *films.covariance, adaptation));
  if (films.spectrum) layers.push_back(spectral_layer(film, *films.spectrum));
  return layers;
}

}  // namespace photopic
