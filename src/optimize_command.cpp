#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "color_bar_plot.h"
#include "commands.h"
#include "core/image_io.h"
#include "density_plot.h"
#include "error.h"
#include "interrupt.h"
#include "messages.h"
#include "optimize_report.h"
#include "optimize_run.h"
#include "output_file.h"
#include "sampler_choice.h"
#include "spectral/lamp_set.h"
#include "spectral/observer.h"
#include "spectral/spectrum_file.h"
#include "visible_lamp.h"
#include "wavelength_comparison.h"

namespace photopic {
namespace {

/// Of powers; their ratios stay finite.
constexpr double kLeastPower = 1e-100, kMostPower = 1e100;

/// "SPECTRUM*POWER" taken apart; a file may have a star in its name.
std::pair<std::string, double> parse_lamp(const std::string& text) {
  const std::size_t star = text.rfind('*');
  std::error_code ignored;
  if (star == std::string::npos || std::filesystem::is_regular_file(text, ignored)) return {text, 1.0};
  double power = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + star + 1, end, power);
  if (error != std::errc() || rest != end || !(power >= kLeastPower && power <= kMostPower))
    throw InputError(text, fmt::format("\"{}\" is not a lamp's power", text.substr(star + 1)),
                     fmt::format("write a number from {} to {} behind the star, as in cie:FL11*2.5",
                                 kLeastPower, kMostPower));
  return {text.substr(0, star), power};
}

void check_color_bar(const std::filesystem::path& file) {
  if (is_svg(file)) return check_writable_plot(file);
  if (!is_image(file))
    throw InputError(file.string(), "the ending is not one of .svg, .exr, .hdr, .png, .jpg",
                     "name the color bar so");
  check_writable_image(file);
}

void check_outputs(const OptimizeArguments& arguments) {
  if (arguments.output.empty() && !arguments.compare_wavelengths)
    throw InputError("--output", "is missing", "name a file for the densities; see photopic optimize --help");
  if (!arguments.output.empty()) check_writable_file(arguments.output);
  if (!arguments.color_bar.empty()) check_color_bar(arguments.color_bar);
  if (!arguments.plot.empty()) check_writable_plot(arguments.plot);
  if (!arguments.json.empty()) check_writable_file(arguments.json);
  std::vector<std::filesystem::path> inputs{arguments.reflectances};
  for (const std::string& text : arguments.spectra) inputs.push_back(parse_lamp(text).first);
  check_no_overwriting({arguments.output, arguments.color_bar, arguments.plot, arguments.json}, inputs);
}

std::vector<TabulatedSpectrum> read_lamps(const std::vector<std::string>& spectra) {
  std::vector<TabulatedSpectrum> lamps;
  std::vector<double> powers;
  for (const std::string& text : spectra) {
    const auto [spectrum, power] = parse_lamp(text);
    lamps.push_back(visible_lamp(parse_spectrum(spectrum, {}, Beyond::zero), spectrum));
    powers.push_back(power);
  }
  return lamp_set(lamps, powers);
}

OptimizeOptions read_options(const OptimizeArguments& arguments) {
  OptimizeOptions options = optimize_options(arguments.wavelengths, arguments.objective, arguments.effort,
                                             arguments.white, arguments.seed);
  options.nodes = arguments.nodes;
  if (arguments.reflectances.empty()) return options;
  if (options.objective != Objective::asymptotic)
    throw InputError("--reflectances", "mean-delta-e looks at white alone", "use --objective asymptotic");
  for (TabulatedSpectrum& reflectance : read_reflectance_file(arguments.reflectances))
    options.reflectances.emplace_back(std::move(reflectance));
  return options;
}

void print_result(const WavelengthDistribution& d, const std::vector<SamplerRow>& samplers, double seconds) {
  print_out(sampler_table(samplers, d.objective));
  print_out(fmt::format("{}, {} wavelengths, {:.2f} s\n", without_controls(d.spectrum), d.components.size(),
                        seconds));
}

void write_json(const OptimizeArguments& arguments, const OptimizeResult& result,
                const std::vector<SamplerRow>& samplers) {
  const WavelengthDistribution& d = result.distribution;
  const nlohmann::ordered_json json = {{"version", PHOTOPIC_VERSION},
                                       {"spectrum", d.spectrum},
                                       {"spectrum_digest", d.spectrum_digest},
                                       {"distribution", arguments.output.string()},
                                       {"wavelengths", d.components.size()},
                                       {"objective", d.objective},
                                       {"effort", arguments.effort},
                                       {"white", arguments.white},
                                       {"seed", arguments.seed},
                                       {"nodes", d.components[0].nodes.size()},
                                       {"targets", d.targets.constructed + d.targets.measured},
                                       {"measured_targets", d.targets.measured},
                                       {"objective_value", d.value},
                                       {"uniform_value", d.uniform_value},
                                       {"visible_value", d.visible_value},
                                       {"illuminant_value", d.illuminant_value},
                                       {"evaluations", result.evaluations},
                                       {"optimize_seconds", result.seconds},
                                       {"samplers", samplers_json(samplers)}};
  write_json_file(arguments.json, json);
}

std::string lamp_names(const OptimizeArguments& arguments) {
  return fmt::format("{}", fmt::join(arguments.spectra, " "));
}

void draw_color_bar(const OptimizeArguments& arguments, const WavelengthDistribution& distribution,
                    const TabulatedSpectrum& light) {
  const auto [uniform, visible, illuminant] = baseline_samplers(arguments.wavelengths, light);
  const std::vector<WavelengthSampler> samplers{uniform, visible, illuminant,
                                                OptimizedWavelengths(distribution)};
  if (is_svg(arguments.color_bar)) {
    write_file(arguments.color_bar, color_bar_plot(distribution.spectrum, samplers, light));
  } else {
    write_color_bar(arguments.color_bar, samplers, light);
  }
}

int run_comparison(const OptimizeArguments& arguments, const std::vector<TabulatedSpectrum>& lamps,
                   const OptimizeOptions& options) {
  const std::string names = lamp_names(arguments);
  const auto optimize = [&](const OptimizeOptions& each) {
    return optimize_with_progress(lamps, fmt::format("{}, {} wavelengths", names, each.wavelengths), each,
                                  arguments.quiet);
  };
  const std::vector<WavelengthRow> rows = compare_wavelength_counts(lamps, options, optimize);
  const nlohmann::ordered_json json = {
      {"version", PHOTOPIC_VERSION},          {"spectrum", names},        {"objective", arguments.objective},
      {"effort", arguments.effort},           {"white", arguments.white}, {"seed", arguments.seed},
      {"wavelengths", wavelengths_json(rows)}};
  OutputAttempts attempt;
  if (!arguments.json.empty()) attempt(arguments.json, [&] { write_json_file(arguments.json, json); });
  if (prints_report(arguments.quiet, arguments.json))
    print_out(fmt::format("{}{}\n", wavelength_table(rows), without_controls(names)));
  return attempt.exit_code(kExitDone);
}

}  // namespace

int run_optimize(const OptimizeArguments& arguments) {
  interrupt_flag();  // from here on Ctrl-C ends the search
  check_outputs(arguments);
  const std::vector<TabulatedSpectrum> lamps = read_lamps(arguments.spectra);
  const OptimizeOptions options = read_options(arguments);
  if (arguments.compare_wavelengths) return run_comparison(arguments, lamps, options);

  OptimizeResult made = optimize_with_progress(lamps, lamp_names(arguments), options, arguments.quiet);
  made.distribution.targets.measured_file = arguments.reflectances.string();
  OutputAttempts attempt;
  attempt(arguments.output, [&] { write_distribution(arguments.output, made.distribution); });
  const TabulatedSpectrum light = mixed_light(lamps);
  if (!arguments.color_bar.empty())
    attempt(arguments.color_bar, [&] { draw_color_bar(arguments, made.distribution, light); });
  if (!arguments.plot.empty())
    attempt(arguments.plot,
            [&] { write_file(arguments.plot, density_plot(made.initial, made.distribution, light)); });
  if (arguments.json.empty() && arguments.quiet) return attempt.exit_code(kExitDone);
  const std::vector<SamplerRow> samplers = measure_samplers(made.distribution, light, options.white);
  if (!arguments.json.empty()) attempt(arguments.json, [&] { write_json(arguments, made, samplers); });
  if (prints_report(arguments.quiet, arguments.json)) print_result(made.distribution, samplers, made.seconds);
  return attempt.exit_code(kExitDone);
}

}  // namespace photopic
