#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "core/film.h"
#include "core/further_films.h"
#include "core/prepared_scene.h"
#include "core/progress.h"
#include "core/sample_sequence.h"
#include "integrator/non_finite.h"
#include "integrator/stage_watch.h"
#include "spectral/observer.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

struct RenderOptions {
  int spp = 64;             ///< samples per pixel, at most
  double seconds = 0;       ///< end after so long, every pixel having a sample; 0: no limit
  double target_error = 0;  ///< end a tile when its expected mean ΔE is this or less; 0: never
  Sequence sequence = Sequence::sobol;
  const Observer* observer = &Observer::cie1931();  ///< whose XYZ the film gathers
  std::uint32_t seed = 0;
  std::optional<PixelWindow> window{};  ///< what alone is rendered, inside the film; none: all of it
  int max_depth = 64;  ///< surfaces met by a path at most; light reaching the camera directly has depth 1
  /// Paths advanced together. Changes no bit of the result, but for which of two surfaces in exactly one
  /// place is met.
  int batch_size = 1024;
  const std::atomic<bool>* stop = nullptr;  ///< set by another thread or a signal: return what is done so far
  Progress* progress = nullptr;             ///< advanced by samples
  FurtherFilms further{};                   ///< fed as the film is; not by the oracle
  StageWatch* watch = nullptr;              ///< told of stages by every thread; for benchmarks
};

/// Samples a pixel at which RenderOptions::target_error is first looked at.
inline constexpr int kFirstLook = 32;

struct RenderStats {
  double seconds = 0;  ///< wall clock
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;  ///< nearest-hit rays, but for those that look for panes, hidden lamps and the
                           ///< media around a point
  std::uint64_t shadow_rays = 0;
  std::uint64_t split_paths = 0;      ///< paths that went on with one wavelength after dispersion
  std::uint64_t media_overflows = 0;  ///< paths that were in more media at once, or met more surfaces in one
                                      ///< place, than are kept
  std::uint64_t media_slips = 0;      ///< paths that left a solid that they had not entered
  std::uint64_t non_finite = 0;       ///< samples that were not finite; left out of the film and counted here
  NonFiniteCounts non_finite_causes;  ///< why; the oracle does not tell
  std::optional<double> expected_delta_e{};  ///< mean over the image; where a target_error was set and more
                                             ///< samples were taken than a stratified run
  bool stopped = false;                      ///< by RenderOptions::stop

  RenderStats& operator+=(const RenderStats& other) {
    paths += other.paths;
    rays += other.rays;
    shadow_rays += other.shadow_rays;
    split_paths += other.split_paths;
    media_overflows += other.media_overflows;
    media_slips += other.media_slips;
    non_finite += other.non_finite;
    non_finite_causes += other.non_finite_causes;
    return *this;
  }
};

struct RenderResult {
  Film film;
  RenderStats stats;
};

/// Unidirectional path tracing with next-event estimation, multiple importance sampling and Russian roulette,
/// in batches; Veach 1997, chapters 8–10. The film has the size of the scene's camera.
/// @throws std::invalid_argument when the sampler's number of wavelengths is not 1, 4, 8 or 16
RenderResult render(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                    const RenderOptions& options);

/// The oracle: one path at a time, BSDF sampling only, no roulette before the depth limit.
RenderResult render_naive(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                          const RenderOptions& options);

}  // namespace photopic
