#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <xmmintrin.h>

#include <chrono>
#include <stdexcept>

#include "integrator/naive_path.h"
#include "integrator/path_stages.h"

namespace photopic {
namespace {

/// A task is a tile of pixels times a few samples of each: large enough to fill a batch, small enough to
/// share out.
constexpr int kTileSize = 16;
constexpr int kSamplesPerPass = 16;

/// Denormals are flushed to zero while it lives: they matter to no picture and cost a hundredfold.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

/// The paths of a tile, sample by sample, so that neighbours in a batch look at nearly the same thing.
std::vector<PathKey> tile_paths(const Camera& camera, int tile, int first_sample, int last_sample) {
  const int tiles_x = (camera.width + kTileSize - 1) / kTileSize;
  const int x0 = tile % tiles_x * kTileSize, y0 = tile / tiles_x * kTileSize;
  const int x1 = std::min(x0 + kTileSize, camera.width), y1 = std::min(y0 + kTileSize, camera.height);
  std::vector<PathKey> paths;
  paths.reserve(static_cast<std::size_t>((x1 - x0) * (y1 - y0) * (last_sample - first_sample)));
  for (int s = first_sample; s < last_sample; ++s)
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        paths.push_back({static_cast<std::uint32_t>(y * camera.width + x), static_cast<std::uint32_t>(s)});
  return paths;
}

int tile_count(const Camera& camera) {
  return ((camera.width + kTileSize - 1) / kTileSize) * ((camera.height + kTileSize - 1) / kTileSize);
}

template <typename Tracer>
RenderResult render_tiles(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                          const RenderOptions& asked) {
  const auto start = std::chrono::steady_clock::now();
  const Camera& camera = scene.scene.camera;
  RenderResult result{Film(camera.width, camera.height), {}};
  RenderOptions options = asked;
  options.batch_size = std::min(asked.batch_size, kTileSize * kTileSize * kSamplesPerPass);  // a task's paths
  tbb::enumerable_thread_specific<Tracer> tracers([&] { return Tracer(scene, wavelengths, options); });

  const auto stopped = [&] {
    return options.stop != nullptr && options.stop->load(std::memory_order_relaxed);
  };
  for (int first = 0; first < options.spp && !stopped(); first += kSamplesPerPass) {
    const int last = std::min(first + kSamplesPerPass, options.spp);
    tbb::parallel_for(0, tile_count(camera), [&](int tile) {
      if (stopped()) return;
      const FlushDenormals flush;
      const std::vector<PathKey> paths = tile_paths(camera, tile, first, last);
      Tracer& tracer = tracers.local();
      const std::size_t batch = static_cast<std::size_t>(options.batch_size);
      for (std::size_t i = 0; i < paths.size(); i += batch)
        tracer.trace(std::span(paths).subspan(i, std::min(batch, paths.size() - i)), result.film);
      if (options.progress != nullptr) options.progress->advance(paths.size());
    });
  }

  RenderStats& stats = result.stats;
  for (const Tracer& tracer : tracers) stats += tracer.stats();
  stats.stopped =
      stats.paths < std::uint64_t(camera.width) * std::uint64_t(camera.height) * std::uint64_t(asked.spp);
  stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

/// The widths that are compiled.
template <template <int> typename Tracer>
RenderResult render_with(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                         const RenderOptions& options) {
  switch (wavelength_count(wavelengths)) {
    case 1:
      return render_tiles<Tracer<1>>(scene, wavelengths, options);
    case 4:
      return render_tiles<Tracer<4>>(scene, wavelengths, options);
    case 8:
      return render_tiles<Tracer<8>>(scene, wavelengths, options);
    case 16:
      return render_tiles<Tracer<16>>(scene, wavelengths, options);
  }
  throw std::invalid_argument("a path carries 1, 4, 8 or 16 wavelengths");
}

}  // namespace

RenderResult render(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                    const RenderOptions& options) {
  return render_with<PathTracer>(scene, wavelengths, options);
}

RenderResult render_naive(const PreparedScene& scene, const WavelengthSampler& wavelengths,
                          const RenderOptions& options) {
  return render_with<NaivePathTracer>(scene, wavelengths, options);
}

}  // namespace photopic
