#include <pmmintrin.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>

#include "integrator/naive_path.h"
#include "integrator/path_stages.h"
#include "integrator/tile.h"
#include "spectral/illuminants.h"

namespace photopic {
namespace {

/// A task is a tile of pixels times a few samples of each: large enough to fill a batch, small enough to
/// share out.
constexpr int kSamplesPerPass = 16;
/// Samples go to two films in turn where their difference is to tell the error. Aligned runs of 8 are well
/// stratified.
constexpr int kSamplesPerFilm = kSamplesPerPass / 2;
/// After kFirstLook samples how many times as many before the next estimate of the error: each look favours
/// luck.
constexpr double kNextLook = 1.25;

/// Denormals are flushed to zero while it lives: they matter to no picture and cost a hundredfold.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON); }
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

/// D65 at Y = 1.
Xyz white_of(const Observer& observer) {
  const Xyz d65 = emission_xyz(cie_illuminant("D65").value(), observer);
  return d65 * (1.0 / d65.y);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Renders tile by tile until every tile has its samples, or its error, or the time is up.
template <typename Tracer>
class TileRenderer {
 public:
  /// @param sampler what the tracers take their wavelengths from
  TileRenderer(const PreparedScene& scene, const auto& sampler, const RenderOptions& asked)
      : camera_(scene.scene.camera),
        options_(asked),
        tiles_(film_tiles(asked.window.value_or(PixelWindow{0, 0, camera_.width, camera_.height}))),
        tracers_([this, &scene, &sampler] { return Tracer(scene, sampler, options_); }),
        film_(camera_.width, camera_.height) {
    const int task = std::ranges::max(tiles_, {}, &Tile::pixel_count).pixel_count() * kSamplesPerPass;
    options_.batch_size = std::min(asked.batch_size, task);
    if (options_.target_error > 0.0) second_film_.emplace(camera_.width, camera_.height);
  }

  RenderResult render() {
    std::vector<Tile> active = tiles_;
    int next_look = kFirstLook;
    for (int first = 0; first < options_.spp && !active.empty() && !(first > 0 && must_end());) {
      const int last = std::min(first + pass_size(first), options_.spp);
      tbb::parallel_for(std::size_t{0}, active.size(), [&](std::size_t i) {
        if (!(first > 0 && must_end()) && !interrupted()) render_tile(active[i], first, last);
      });
      if (second_film_ && last >= next_look) {
        std::erase_if(active, [&](const Tile& tile) {
          const auto error = expected_delta_e(film_, *second_film_, tile, white_);
          return error && *error <= options_.target_error;
        });
        next_look = static_cast<int>(kNextLook * last);
      }
      first = last;
    }
    return result();
  }

 private:
  bool interrupted() const {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }
  bool must_end() const {
    return interrupted() || (options_.seconds > 0.0 && seconds_since(start_) >= options_.seconds);
  }

  /// Against the clock the first passes are small: every pixel gets a sample.
  int pass_size(int first) const {
    return options_.seconds > 0.0 ? std::clamp(first, 1, kSamplesPerPass) : kSamplesPerPass;
  }

  void render_tile(const Tile& tile, int first, int last) {
    const FlushDenormals flush;
    if (!second_film_) {
      trace(tile_paths(tile, camera_.width, first, last), film_);
      return;
    }
    for (int s = first; s < last;) {
      const int block = s / kSamplesPerFilm, end = std::min((block + 1) * kSamplesPerFilm, last);
      trace(tile_paths(tile, camera_.width, s, end), block % 2 == 0 ? film_ : *second_film_);
      s = end;
    }
  }

  void trace(const std::vector<PathKey>& paths, Film& film) {
    Tracer& tracer = tracers_.local();
    const auto batch = static_cast<std::size_t>(options_.batch_size);
    for (std::size_t i = 0; i < paths.size(); i += batch)
      tracer.trace(std::span(paths).subspan(i, std::min(batch, paths.size() - i)), film);
    if (options_.progress != nullptr) options_.progress->advance(paths.size());
  }

  RenderResult result() {
    RenderStats stats;
    for (const Tracer& tracer : tracers_) stats += tracer.stats();
    stats.stopped = interrupted();
    if (second_film_) {
      stats.expected_delta_e = expected_delta_e(film_, *second_film_, tiles_, white_);
      film_ += *second_film_;
    }
    stats.seconds = seconds_since(start_);
    return {std::move(film_), stats};
  }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const Camera& camera_;
  RenderOptions options_;
  const std::vector<Tile> tiles_;
  tbb::enumerable_thread_specific<Tracer> tracers_;
  Film film_;
  const Xyz white_ = white_of(*options_.observer);
  std::optional<Film> second_film_;  ///< of every other run of samples, where the error is asked for
};

/// Calls render with the number of wavelengths as a constant.
template <typename Render>
RenderResult with_width(const WavelengthSampler& wavelengths, const Render& render) {
  switch (wavelength_count(wavelengths)) {
    case 1:
      return render(std::integral_constant<int, 1>{});
    case 4:
      return render(std::integral_constant<int, 4>{});
    case 8:
      return render(std::integral_constant<int, 8>{});
    case 16:
      return render(std::integral_constant<int, 16>{});
  }
  throw std::invalid_argument("a path carries 1, 4, 8 or 16 wavelengths");
}

template <Features kHas>
RenderResult render_with(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                         const RenderOptions& options) {
  const CompiledSampler sampler(wavelengths, *options.observer, scene.scene.emission_spectra);
  return with_width(wavelengths, [&]<int N>(std::integral_constant<int, N>) {
    return TileRenderer<PathTracer<N, kHas>>(scene, sampler, options).render();
  });
}

}  // namespace

RenderResult render(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                    const RenderOptions& options) {
  const Features has = features_of(scene);
  if (kPlain.cover(has)) return render_with<kPlain>(scene, wavelengths, options);
  if (kManyLights.cover(has)) return render_with<kManyLights>(scene, wavelengths, options);
  if (kTextured.cover(has)) return render_with<kTextured>(scene, wavelengths, options);
  if (kGlass.cover(has)) return render_with<kGlass>(scene, wavelengths, options);
  return render_with<kEverything>(scene, wavelengths, options);
}

RenderResult render_naive(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                          const RenderOptions& options) {
  return with_width(wavelengths, [&]<int N>(std::integral_constant<int, N>) {
    return TileRenderer<NaivePathTracer<N>>(scene, wavelengths, options).render();
  });
}

}  // namespace photopic
