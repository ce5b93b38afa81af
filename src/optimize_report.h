#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "optimize/sampler_report.h"
#include "spectral/wavelength_distribution.h"

namespace photopic {

/// A row of optimize's table.
struct SamplerRow {
  std::string name;
  double objective_value = 0;  ///< [ΔE]
  SamplerReport report;
};

/// The baselines and the result, measured under the lamps together.
std::vector<SamplerRow> measure_samplers(const WavelengthDistribution& distribution,
                                         const TabulatedSpectrum& light, White white);

/// The table for a terminal; `objective` heads the column of objective values, gains are to the first row.
std::string sampler_table(const std::vector<SamplerRow>& rows, const std::string& objective);

/// Its figures, into an object.
void add_report(nlohmann::ordered_json& json, const SamplerReport& report);

/// An array with an object for each sampler.
nlohmann::ordered_json samplers_json(const std::vector<SamplerRow>& rows);

}  // namespace photopic
