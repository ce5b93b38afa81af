#include "run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace photopic {
namespace {

/// @param f takes the name and the count of each cause that occurred
template <typename F>
void for_each_cause(const NonFiniteCounts& counts, F f) {
  for (std::size_t i = 0; i < kNonFiniteCauses; ++i)
    if (counts.of[i] > 0) f(kNonFiniteCauseNames[i], counts.of[i]);
}

}  // namespace

Run make_run(const std::string& sampler, int spp, int wavelengths, std::uint32_t seed, const Film& film,
             const RenderStats& stats) {
  Run run;
  run.sampler = sampler;
  run.spp = spp;
  run.mean_spp = static_cast<double>(stats.paths) / static_cast<double>(film.width()) /
                 static_cast<double>(film.height());
  run.wavelengths = wavelengths;
  run.seed = seed;
  run.render_seconds = stats.seconds;
  run.stats = stats;
  run.mean = film.image_mean();
  const auto pixels = static_cast<std::uint64_t>(film.width()) * static_cast<std::uint64_t>(film.height());
  if (stats.paths >= 2 * pixels) run.variance_of_mean = film.image_variance_of_mean();
  return run;
}

nlohmann::ordered_json run_json(const Run& run) {
  nlohmann::ordered_json json = {
      {"sampler", run.sampler},
      {"image", run.image.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(run.image)},
      {"spp", run.spp},
      {"mean_spp", run.mean_spp},
      {"wavelengths", run.wavelengths},
      {"seed", run.seed},
      {"render_seconds", run.render_seconds},
      {"samples_per_second", run.samples_per_second()},
      {"rays_per_second", run.rays_per_second()},
  };
  add_metrics(json, run.metrics);
  const auto& expected = run.stats.expected_delta_e;
  json["expected_mean_delta_e"] = expected ? nlohmann::ordered_json(*expected) : nlohmann::ordered_json();
  json["non_finite_samples"] = run.stats.non_finite;
  json["non_finite_causes"] = nlohmann::ordered_json::object();
  for_each_cause(run.stats.non_finite_causes, [&](std::string_view cause, std::uint64_t count) {
    json["non_finite_causes"][std::string(cause)] = count;
  });
  json["split_samples"] = run.stats.split_paths;
  json["optimize_seconds"] = run.optimize_seconds;
  json["mean_xyz"] = {run.mean.x, run.mean.y, run.mean.z};
  json["mean_xyz_standard_error"] = nullptr;
  if (const auto& v = run.variance_of_mean)
    json["mean_xyz_standard_error"] = {std::sqrt(v->x), std::sqrt(v->y), std::sqrt(v->z)};
  return json;
}

void add_metrics(nlohmann::ordered_json& json, const std::optional<ImageDifference>& metrics) {
  const auto field = [&](const char* name, double ImageDifference::*value) {
    json[name] = metrics ? nlohmann::ordered_json((*metrics).*value) : nlohmann::ordered_json();
  };
  field("mean_delta_e", &ImageDifference::mean_delta_e);
  field("median_delta_e", &ImageDifference::median_delta_e);
  field("p95_delta_e", &ImageDifference::p95_delta_e);
  field("max_delta_e", &ImageDifference::max_delta_e);
  field("mse", &ImageDifference::mse);
  field("relmse", &ImageDifference::relmse);
  json["non_finite_pixels"] =
      metrics ? nlohmann::ordered_json(metrics->non_finite) : nlohmann::ordered_json();
}

std::string format_non_finite(const RenderStats& stats) {
  std::string causes;
  for_each_cause(stats.non_finite_causes, [&](std::string_view cause, std::uint64_t count) {
    causes += fmt::format("{}{} {}", causes.empty() ? "" : ", ", cause, count);
  });
  return fmt::format("{}{}", stats.non_finite, causes.empty() ? "" : " (" + causes + ")");
}

std::string format_means(const Run& run) {
  const auto error = [&](double Xyz::*channel) {
    return run.variance_of_mean ? fmt::format("{:.2g}", std::sqrt((*run.variance_of_mean).*channel)) : "-";
  };
  return fmt::format("X {:.6g} ± {}, Y {:.6g} ± {}, Z {:.6g} ± {}", run.mean.x, error(&Xyz::x), run.mean.y,
                     error(&Xyz::y), run.mean.z, error(&Xyz::z));
}

std::optional<Agreement> channel_agreement(const std::vector<Run>& runs) {
  const auto unknown = [](const Run& run) { return !run.variance_of_mean; };
  if (runs.size() < 2 || std::ranges::any_of(runs, unknown)) return std::nullopt;
  Agreement largest;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t j = i + 1; j < runs.size(); ++j) {
      const Xyz difference = runs[i].mean - runs[j].mean;
      const Xyz variance = *runs[i].variance_of_mean + *runs[j].variance_of_mean;
      const std::array<double, 3> d{difference.x, difference.y, difference.z},
          v{variance.x, variance.y, variance.z};
      for (std::size_t c = 0; c < 3; ++c) {
        const double z = d[c] == 0 ? 0 : std::abs(d[c]) / std::sqrt(v[c]);
        if (z > largest.largest_z || largest.first.empty())
          largest = {z, runs[i].sampler, runs[j].sampler, "XYZ"[c]};
      }
    }
  }
  return largest;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace photopic
