#include "comparison.h"

#include <fmt/format.h>

#include "text_table.h"

namespace photopic {
namespace {

using Json = nlohmann::ordered_json;

/// How many times smaller the error is than the first run's; null for 0/0.
std::optional<double> gain(const Run& first, const Run& run) {
  if (run.metrics->mean_delta_e == 0) return std::nullopt;
  return first.metrics->mean_delta_e / run.metrics->mean_delta_e;
}

std::string format_gain(const std::optional<double>& gain) {
  return gain ? fmt::format("{:.2f}x", *gain) : "-";
}

/// @param timed runs differ in their samples a pixel
std::string runs_table(const std::vector<Run>& runs, bool timed) {
  std::vector<std::vector<std::string>> rows{{"sampler", "mean ΔE", "median", "p95", "max", "gain", "seconds",
                                              "time", "M samples/s", "M rays/s", "optimise s", "non-finite"}};
  if (timed) rows.front().insert(rows.front().begin() + 1, "samples/pixel");
  for (const Run& run : runs) {
    const ImageDifference& m = *run.metrics;
    rows.push_back({run.sampler, fmt::format("{:.3f}", m.mean_delta_e),
                    fmt::format("{:.3f}", m.median_delta_e), fmt::format("{:.3f}", m.p95_delta_e),
                    fmt::format("{:.2f}", m.max_delta_e), format_gain(gain(runs.front(), run)),
                    fmt::format("{:.2f}", run.render_seconds), fmt::format("{:.3f}x", run.time_ratio),
                    fmt::format("{:.3f}", run.samples_per_second() * 1e-6),
                    fmt::format("{:.3f}", run.rays_per_second() * 1e-6),
                    fmt::format("{:.2f}", run.optimize_seconds), fmt::format("{}", run.stats.non_finite)});
    if (timed) rows.back().insert(rows.back().begin() + 1, fmt::format("{:.1f}", run.mean_spp));
  }
  return format_table(rows);
}

std::string curves_table(const std::vector<ErrorCurve>& curves) {
  std::vector<std::vector<std::string>> rows{{"mean ΔE at spp"}};
  for (int spp : curves.front().spp) rows.front().push_back(std::to_string(spp));
  for (const ErrorCurve& curve : curves) {
    rows.push_back({curve.sampler});
    for (double value : curve.mean_delta_e) rows.back().push_back(fmt::format("{:.3f}", value));
    rows.push_back({"  seconds"});
    for (double value : curve.seconds) rows.back().push_back(fmt::format("{:.3f}", value));
  }
  return format_table(rows);
}

}  // namespace

std::string format_comparison(const Comparison& comparison) {
  std::string text =
      runs_table(comparison.runs, comparison.timed) + "\nreference: " + comparison.reference.description;
  if (comparison.reference.own_error)
    text += fmt::format(", its own mean ΔE about {:.3f}", *comparison.reference.own_error);
  text += fmt::format("; white of ΔE: {}\n", comparison.white);
  if (const auto agreement = channel_agreement(comparison.runs))
    text += fmt::format("channel means: largest |z| = {:.2f} ({} of {} and {})\n", agreement->largest_z,
                        agreement->channel, agreement->first, agreement->second);
  else if (comparison.runs.size() > 1)
    text += "channel means: - (one sample a pixel has no variance)\n";
  if (!comparison.curves.empty()) text += "\n" + curves_table(comparison.curves);
  return text;
}

Json comparison_json(const Comparison& comparison) {
  const Reference& reference = comparison.reference;
  Json json = {
      {"version", PHOTOPIC_VERSION}, {"interrupted", comparison.interrupted}, {"white", comparison.white}};
  json["reference"] = {{"description", reference.description},
                       {"image", reference.file.empty() ? Json() : Json(reference.file)},
                       {"spp", reference.spp > 0 ? Json(reference.spp) : Json()},
                       {"render_seconds", reference.spp > 0 ? Json(reference.render_seconds) : Json()},
                       {"estimated_mean_delta_e", reference.own_error ? Json(*reference.own_error) : Json()}};
  json["runs"] = Json::array();
  for (const Run& run : comparison.runs) {
    Json entry = run_json(run);
    const auto times_smaller = gain(comparison.runs.front(), run);
    entry["gain"] = times_smaller ? Json(*times_smaller) : Json();
    entry["time_ratio"] = run.time_ratio;
    json["runs"].push_back(std::move(entry));
  }
  if (const auto agreement = channel_agreement(comparison.runs))
    json["channel_agreement"] = {{"largest_z", agreement->largest_z},
                                 {"samplers", {agreement->first, agreement->second}},
                                 {"channel", std::string(1, agreement->channel)}};
  for (const ErrorCurve& curve : comparison.curves)
    json["curves"].push_back({{"sampler", curve.sampler},
                              {"spp", curve.spp},
                              {"seconds", curve.seconds},
                              {"mean_delta_e", curve.mean_delta_e}});
  return json;
}

}  // namespace photopic
