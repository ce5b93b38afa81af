#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image_metrics.h"
#include "integrator/integrator.h"

namespace photopic {

/// One render, or one existing image, as tables and JSON tell of it.
struct Run {
  std::string sampler;
  std::string image;    ///< the file it was written to or read from; empty: none
  int spp = 0;          ///< asked for; of a limited render: taken, rounded
  double mean_spp = 0;  ///< taken, mean over the pixels
  int wavelengths = 0;
  std::uint32_t seed = 0;
  double render_seconds = 0;  ///< median over the rounds
  double time_ratio = 1;      ///< median over the rounds of the time's ratio to the first run's
  double optimize_seconds = 0;
  RenderStats stats;
  Xyz mean;  ///< of the image's XYZ
  std::optional<Xyz>
      variance_of_mean;  ///< of that mean, as if samples were independent; of one a pixel: none
  std::optional<ImageDifference> metrics;

  double samples_per_second() const { return static_cast<double>(stats.paths) / render_seconds; }
  /// Nearest-hit and shadow rays.
  double rays_per_second() const {
    return static_cast<double>(stats.rays + stats.shadow_rays) / render_seconds;
  }
};

/// A run with what film and stats say; `render_seconds` is the stats'. @param film of what was rendered alone
Run make_run(const std::string& sampler, int spp, int wavelengths, std::uint32_t seed, const Film& film,
             const RenderStats& stats);

/// A run as JSON files tell of it. What is not known (of an existing image, without a reference) is null.
nlohmann::ordered_json run_json(const Run& run);

/// The fields of run_json that metrics fill.
void add_metrics(nlohmann::ordered_json& json, const std::optional<ImageDifference>& metrics);

/// "3 (camera 1, emission 2)", or "0".
std::string format_non_finite(const RenderStats& stats);

/// XYZ means with their standard errors, one line.
std::string format_means(const Run& run);

/// The largest |z| of the differences of two runs' channel means.
struct Agreement {
  double largest_z = 0;
  std::string first, second;  ///< the samplers
  char channel = 'X';
};
/// Nothing for fewer than two runs, or when a variance is not known.
std::optional<Agreement> channel_agreement(const std::vector<Run>& runs);

/// @param values at least one
double median(std::vector<double> values);

}  // namespace photopic
