#include "distribution_cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "error.h"
#include "messages.h"
#include "optimize/reflectance_set.h"
#include "optimize_run.h"
#include "spectral/lamp_set.h"

namespace photopic {
namespace {

namespace fs = std::filesystem;

/// Part of the files' names: to be counted up when the optimiser's results or the files' format change.
constexpr int kCacheVersion = 3;

std::optional<fs::path> cache_folder() {
  // The XDG base directory specification has relative paths ignored.
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "photopic";
  const char* home = std::getenv("HOME");
  if (home && fs::path(home).is_absolute()) return fs::path(home) / ".cache" / "photopic";
  return std::nullopt;
}

fs::path cache_file(const fs::path& folder, std::span<const TabulatedSpectrum> lamps,
                    const OptimizeOptions& options) {
  const std::string measured = reflectances_digest(options.reflectances);
  return folder / fmt::format("{}-n{}-o{}-e{}-w{}-s{}-k{}-t{}{}-v{}.json", digest(lamps), options.wavelengths,
                              static_cast<int>(options.objective), static_cast<int>(options.effort),
                              static_cast<int>(options.white), options.seed, options.nodes,
                              options.target_count, measured, kCacheVersion);
}

std::optional<WavelengthDistribution> read_cached(const fs::path& file,
                                                  std::span<const TabulatedSpectrum> lamps,
                                                  const OptimizeOptions& options) {
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  try {
    WavelengthDistribution distribution = read_distribution(file);
    if (distribution.spectrum_digest != digest(lamps) ||
        static_cast<int>(distribution.components.size()) != options.wavelengths)
      throw InputError(file.string(), "is not what its name says", "remove it");
    return distribution;
  } catch (const InputError& problem) {
    print_warning(fmt::format("damaged cache file, optimising anew: {}", problem.what()));
    return std::nullopt;
  }
}

void write_cached(const fs::path& file, const WavelengthDistribution& distribution) {
  try {
    fs::create_directories(file.parent_path());
    write_distribution(file, distribution);
  } catch (const std::exception& problem) {
    print_warning(fmt::format(
        "cannot keep the distribution in the cache: {}; set XDG_CACHE_HOME to a folder for it, or "
        "give --no-cache",
        problem.what()));
  }
}

}  // namespace

WavelengthDistribution cached_distribution(std::span<const TabulatedSpectrum> lamps, const std::string& name,
                                           const OptimizeOptions& options, bool use_cache, bool quiet) {
  const std::optional<fs::path> folder = use_cache ? cache_folder() : std::nullopt;
  const fs::path file = folder ? cache_file(*folder, lamps, options) : fs::path();
  if (folder)
    if (auto distribution = read_cached(file, lamps, options)) return std::move(*distribution);
  OptimizeResult made = optimize_with_progress(lamps, name, options, quiet);
  if (folder) write_cached(file, made.distribution);
  return std::move(made.distribution);
}

}  // namespace photopic
