#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image_io.h"
#include "run_report.h"

namespace photopic {

/// What runs are measured against.
struct Reference {
  Image image;
  std::string description;  ///< "optimized, 1024 spp" or the file
  std::string file;         ///< read from or written to; empty: none
  int spp = 0;              ///< 0: an existing image
  double render_seconds = 0;
  std::optional<double> own_error;  ///< its estimated mean ΔE to the truth; nothing for an existing image
};

/// The mean ΔE of one sampler, and what it took, at several numbers of samples.
struct ErrorCurve {
  std::string sampler;
  std::vector<int> spp;
  std::vector<double> seconds;  ///< of wall clock, rendering alone
  std::vector<double> mean_delta_e;
};

/// Everything that a comparison found.
struct Comparison {
  Reference reference;
  std::vector<Run> runs;
  std::vector<ErrorCurve> curves;
  std::string white;
  bool timed = false;  ///< the runs had equal times, not equal numbers of samples
  bool interrupted = false;
};

/// The table of the runs, the reference's own error, the agreement of the channel means and the curves, as
/// text.
std::string format_comparison(const Comparison& comparison);

nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace photopic
