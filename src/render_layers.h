#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "core/further_films.h"
#include "core/prepared_scene.h"

namespace photopic {

/// What RenderArguments::aovs may name.
inline const std::vector<std::string> kAovs{"albedo", "normal", "depth", "alpha", "samples", "variance"};
inline constexpr int kMostSpectralBins = 470;  ///< 1 nm each

/// The films that a render must feed for its layers; none where none are asked for.
class LayerFilms {
 public:
  /// @throws InputError when the spectra would take too much memory
  LayerFilms(const RenderArguments& arguments, const Camera& camera);
  FurtherFilms to_feed();

  std::optional<CovarianceFilm> covariance;
  std::optional<SpectralFilm> spectrum;
};

/// The layers of a render's EXR files. They refer to the films, which must live as long.
/// @param film the render's @param adaptation of the picture, and so of its variance
std::vector<ImageLayer> make_layers(const RenderArguments& arguments, const PreparedScene& scene,
                                    const Film& film, const LayerFilms& films,
                                    const ChromaticAdaptation& adaptation);

}  // namespace photopic
