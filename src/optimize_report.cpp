#include "optimize_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "spectral/wavelength_sampler.h"
#include "text_table.h"

namespace photopic {

std::vector<SamplerRow> measure_samplers(const WavelengthDistribution& distribution,
                                         const TabulatedSpectrum& light, White white) {
  const int count = static_cast<int>(distribution.components.size());
  const auto row = [&](const WavelengthSampler& sampler, double value) {
    return SamplerRow{std::string(sampler_name(sampler)), value, sampler_report(sampler, light, white)};
  };
  const auto [uniform, visible, illuminant] = baseline_samplers(count, light);
  return {row(uniform, distribution.uniform_value), row(visible, distribution.visible_value),
          row(illuminant, distribution.illuminant_value),
          row(OptimizedWavelengths(distribution), distribution.value)};
}

std::string sampler_table(const std::vector<SamplerRow>& rows, const std::string& objective) {
  std::vector<std::vector<std::string>> cells{{"ΔE of a sampler", objective, "gain", "1 path, white",
                                               "64 paths, white", "64 paths, reflectances",
                                               "σ of luminance"}};
  for (const SamplerRow& row : rows)
    cells.push_back({row.name, fmt::format("{:.3f}", row.objective_value),
                     fmt::format("{:.2f}x", rows[0].objective_value / row.objective_value),
                     fmt::format("{:.2f}", row.report.one_path_delta_e),
                     fmt::format("{:.3f}", row.report.white_delta_e),
                     fmt::format("{:.3f}", row.report.reflectances_delta_e),
                     fmt::format("{:.1f} %", 100.0 * row.report.luminance_deviation)});
  return format_table(cells);
}

nlohmann::ordered_json samplers_json(const std::vector<SamplerRow>& rows) {
  auto json = nlohmann::ordered_json::array();
  for (const SamplerRow& row : rows) {
    json.push_back({{"sampler", row.name}, {"objective_value", row.objective_value}});
    add_report(json.back(), row.report);
  }
  return json;
}

void add_report(nlohmann::ordered_json& json, const SamplerReport& report) {
  json["one_path_delta_e"] = report.one_path_delta_e;
  json["delta_e_64_paths_white"] = report.white_delta_e;
  json["delta_e_64_paths_reflectances"] = report.reflectances_delta_e;
  json["luminance_relative_deviation"] = report.luminance_deviation;
}

}  // namespace photopic
