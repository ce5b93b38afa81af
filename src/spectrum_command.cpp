#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "commands.h"
#include "error.h"
#include "messages.h"
#include "output_file.h"
#include "spectral/lamp_description.h"
#include "spectral/spectrum_file.h"
#include "spectrum_plot.h"
#include "text_table.h"
#include "visible_lamp.h"

namespace photopic {
namespace {

/// What the user gave, as given; a formula has no samples.
struct GivenTable {
  std::size_t samples = 0;
  double first = kLambdaMin, last = kLambdaMax;  ///< [nm]
};

GivenTable given_table(const Spectrum& spectrum) {
  const auto* table = std::get_if<TabulatedSpectrum>(&spectrum);
  if (!table) return {};
  return {table->lambda().size(), table->lambda().front(), table->lambda().back()};
}

double share_of_lines(const LampDescription& lamp) {
  double share = 0.0;
  for (const EmissionLine& line : lamp.lines) share += line.luminance_share;
  return share;
}

/// Four decimals; what they round to nothing has no sign.
std::string duv_text(double duv) {
  return std::abs(duv) < 0.5e-4 ? "0.0000" : fmt::format("{:+.4f}", duv);
}

std::string temperature_text(const LampDescription& lamp) {
  if (!lamp.temperature) return "none: not near a blackbody of 1000 to 25000 K";
  const CorrelatedTemperature& t = *lamp.temperature;
  if (!t.meaningful())
    return fmt::format("none: too far from the Planckian locus (Duv {}; CIE 015 allows {:g})",
                       duv_text(t.duv), CorrelatedTemperature::kFarthest);
  return fmt::format("{:.0f} K, Duv {}", t.kelvin, duv_text(t.duv));
}

std::string table_text(const GivenTable& given) {
  if (given.samples == 0) return "a formula, taken from 360 to 830 nm";
  return fmt::format("{:g} to {:g} nm, {} samples", given.first, given.last, given.samples);
}

std::string format_lamp(const std::string& name, const GivenTable& given, const LampDescription& lamp) {
  std::string text;
  const auto add = [&]<typename... T>(fmt::format_string<T...> format, T&&... values) {
    text += fmt::format(format, std::forward<T>(values)...);
  };
  add("{}\n", without_controls(name));
  add("  given         {}\n", table_text(given));
  add("  chromaticity  x {:.4f}, y {:.4f} (CIE 1931)\n", lamp.chromaticity.x, lamp.chromaticity.y);
  add("  temperature   {}\n", temperature_text(lamp));
  add("  efficacy      {:.1f} lm/W (of the radiation from 360 to 830 nm)\n", lamp.efficacy);
  add("  luminance     90 % from {:.1f} to {:.1f} nm\n", lamp.luminance_from, lamp.luminance_to);
  add("  peak          {}\n", lamp.peak ? fmt::format("{:.1f} nm", *lamp.peak) : "none: flat");
  if (lamp.lines.empty()) return text + "  lines         none\n";
  add("  lines         {}, with {:.1f} % of the luminance\n\n", lamp.lines.size(),
      100.0 * share_of_lines(lamp));
  std::vector<std::vector<std::string>> rows{{"line [nm]", "width [nm]", "power [%]", "luminance [%]"}};
  for (const EmissionLine& line : lamp.lines)
    rows.push_back({fmt::format("{:.2f}", line.wavelength), fmt::format("{:.3g}", line.fwhm),
                    fmt::format("{:.2f}", 100.0 * line.power_share),
                    fmt::format("{:.2f}", 100.0 * line.luminance_share)});
  return text + format_table(rows);
}

/// Temperature and peak are null where they mean nothing.
nlohmann::ordered_json lamp_json(const std::string& name, const GivenTable& given,
                                 const LampDescription& lamp, const std::string& digest) {
  nlohmann::ordered_json json = {{"version", PHOTOPIC_VERSION},
                                 {"spectrum", name},
                                 {"spectrum_digest", digest},
                                 {"samples", given.samples},
                                 {"range_nm", {given.first, given.last}},
                                 {"x", lamp.chromaticity.x},
                                 {"y", lamp.chromaticity.y},
                                 {"cct_kelvin", nullptr},
                                 {"duv", nullptr},
                                 {"efficacy_lm_per_w", lamp.efficacy},
                                 {"luminance_90_percent_nm", {lamp.luminance_from, lamp.luminance_to}},
                                 {"peak_nm", nullptr},
                                 {"lines_luminance_share", share_of_lines(lamp)},
                                 {"lines", nlohmann::ordered_json::array()}};
  if (lamp.temperature) json["duv"] = lamp.temperature->duv;
  if (lamp.temperature && lamp.temperature->meaningful()) json["cct_kelvin"] = lamp.temperature->kelvin;
  if (lamp.peak) json["peak_nm"] = *lamp.peak;
  for (const EmissionLine& line : lamp.lines)
    json["lines"].push_back({{"nm", line.wavelength},
                             {"fwhm_nm", line.fwhm},
                             {"power_share", line.power_share},
                             {"luminance_share", line.luminance_share}});
  return json;
}

}  // namespace

int run_spectrum(const SpectrumArguments& arguments) {
  if (!arguments.plot.empty()) check_writable_plot(arguments.plot);
  if (!arguments.json.empty()) check_writable_file(arguments.json);
  check_no_overwriting({arguments.plot, arguments.json}, {arguments.spectrum});
  const std::string& name = arguments.spectrum;
  const Spectrum spectrum = parse_spectrum(name, {}, Beyond::zero);
  const TabulatedSpectrum emission = visible_lamp(spectrum, name);
  const LampDescription lamp = describe_lamp(emission);
  const GivenTable given = given_table(spectrum);
  OutputAttempts attempt;
  if (!arguments.plot.empty()) {
    const std::string colors = fmt::format("x {:.4f}, y {:.4f}; correlated colour temperature {}",
                                           lamp.chromaticity.x, lamp.chromaticity.y, temperature_text(lamp));
    attempt(arguments.plot, [&] { write_file(arguments.plot, spectrum_plot(emission, lamp, name, colors)); });
  }
  if (!arguments.json.empty())
    attempt(arguments.json,
            [&] { write_json_file(arguments.json, lamp_json(name, given, lamp, digest(emission))); });
  if (prints_report(arguments.quiet, arguments.json)) print_out(format_lamp(name, given, lamp));
  return attempt.exit_code(kExitDone);
}

}  // namespace photopic
