#include "wavelength_comparison.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "optimize_report.h"
#include "spectral/lamp_set.h"
#include "spectral/wavelength_sampler.h"
#include "text_table.h"

namespace photopic {
namespace {

void measure_baselines(WavelengthRow& row, const TabulatedSpectrum& light, White white) {
  for (const WavelengthSampler& sampler : baseline_samplers(row.wavelengths, light)) {
    const SamplerReport report = sampler_report(sampler, light, white);
    if (!row.baseline.empty() && report.reflectances_delta_e >= row.best_baseline.reflectances_delta_e)
      continue;
    row.baseline = sampler_name(sampler);
    row.best_baseline = report;
  }
}

}  // namespace

std::vector<WavelengthRow> compare_wavelength_counts(
    std::span<const TabulatedSpectrum> lamps, OptimizeOptions options,
    const std::function<OptimizeResult(const OptimizeOptions&)>& optimize) {
  const TabulatedSpectrum light = mixed_light(lamps);
  std::vector<WavelengthRow> rows;
  for (const int count : {1, 2, 4, 8, 16}) {
    options.wavelengths = count;
    const OptimizeResult made = optimize(options);
    WavelengthRow row;
    row.wavelengths = count;
    row.optimize_seconds = made.seconds;
    row.optimized = sampler_report(OptimizedWavelengths(made.distribution), light, options.white);
    measure_baselines(row, light, options.white);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string wavelength_table(const std::vector<WavelengthRow>& rows) {
  std::vector<std::vector<std::string>> cells{{"wavelengths", "64 paths, reflectances", "best baseline",
                                               "gain", "64 paths, white", "best baseline", "1 path, white",
                                               "best baseline", "seconds"}};
  for (const WavelengthRow& row : rows)
    cells.push_back(
        {fmt::format("{}", row.wavelengths), fmt::format("{:.3f}", row.optimized.reflectances_delta_e),
         fmt::format("{:.3f} ({})", row.best_baseline.reflectances_delta_e, row.baseline),
         fmt::format("{:.2f}x", row.best_baseline.reflectances_delta_e / row.optimized.reflectances_delta_e),
         fmt::format("{:.3f}", row.optimized.white_delta_e),
         fmt::format("{:.3f}", row.best_baseline.white_delta_e),
         fmt::format("{:.2f}", row.optimized.one_path_delta_e),
         fmt::format("{:.2f}", row.best_baseline.one_path_delta_e),
         fmt::format("{:.2f}", row.optimize_seconds)});
  return "ΔE of optimised densities and of the best sampler that needs none\n" + format_table(cells);
}

nlohmann::ordered_json wavelengths_json(const std::vector<WavelengthRow>& rows) {
  const auto report = [](const std::string& name, const SamplerReport& r) {
    nlohmann::ordered_json json = {{"sampler", name}};
    add_report(json, r);
    return json;
  };
  auto json = nlohmann::ordered_json::array();
  for (const WavelengthRow& row : rows)
    json.push_back({{"wavelengths", row.wavelengths},
                    {"optimized", report("optimized", row.optimized)},
                    {"best_baseline", report(row.baseline, row.best_baseline)},
                    {"optimize_seconds", row.optimize_seconds}});
  return json;
}

}  // namespace photopic
