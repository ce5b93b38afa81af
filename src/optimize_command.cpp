#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "commands.h"
#include "core/image_io.h"
#include "error.h"
#include "optimize_run.h"
#include "output_file.h"
#include "sampler_choice.h"
#include "spectral/observer.h"
#include "spectral/spectrum_file.h"
#include "text_table.h"

namespace photopic {
namespace {

void check_outputs(const OptimizeArguments& arguments) {
  check_writable_file(arguments.output);
  if (!arguments.color_bar.empty()) check_writable_image(arguments.color_bar);
  if (!arguments.json.empty()) check_writable_file(arguments.json);
}

/// The lamp as a table that gives some visible light.
TabulatedSpectrum read_lamp(const std::string& text) {
  const Spectrum spectrum = parse_spectrum(text, ".", Beyond::zero);
  try {
    TabulatedSpectrum lamp = tabulate_emission(spectrum);
    if (emission_xyz(lamp, Observer::cie1931()).y > 0) return lamp;
  } catch (const std::invalid_argument& problem) {
    throw InputError(text, problem.what(), "give the spectrum of a lamp");
  }
  throw InputError(text, "gives no visible light between 360 and 830 nm", "give the spectrum of a lamp");
}

void print_result(const WavelengthDistribution& d, double seconds) {
  const auto row = [&](const char* name, double value) {
    return std::vector<std::string>{name, fmt::format("{:.3f}", value),
                                    fmt::format("{:.2f}x", d.uniform_value / value)};
  };
  fmt::print("{}", format_table({{"sampler", d.objective + " ΔE", "gain"},
                                 row("uniform", d.uniform_value),
                                 row("visible", d.visible_value),
                                 row("illuminant", d.illuminant_value),
                                 row("optimized", d.value)}));
  fmt::print("{}, {} wavelengths, {:.2f} s\n", d.spectrum, d.components.size(), seconds);
}

void write_json(const OptimizeArguments& arguments, const OptimizeResult& result) {
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
                                       {"objective_value", d.value},
                                       {"uniform_value", d.uniform_value},
                                       {"visible_value", d.visible_value},
                                       {"illuminant_value", d.illuminant_value},
                                       {"evaluations", result.evaluations},
                                       {"optimize_seconds", result.seconds}};
  write_text_file(arguments.json, json.dump(2) + "\n");
}

}  // namespace

int run_optimize(const OptimizeArguments& arguments) {
  check_outputs(arguments);
  const TabulatedSpectrum lamp = read_lamp(arguments.spectrum);
  const OptimizeOptions options = optimize_options(arguments.wavelengths, arguments.objective,
                                                   arguments.effort, arguments.white, arguments.seed);
  const OptimizeResult made = optimize_with_progress(lamp, arguments.spectrum, options, arguments.quiet);

  write_distribution(arguments.output, made.distribution);
  if (!arguments.color_bar.empty()) {
    const int count = arguments.wavelengths;
    const std::vector<WavelengthSampler> samplers{UniformWavelengths{count}, VisibleWavelengths{count},
                                                  IlluminantWavelengths{count, base_density(lamp)},
                                                  OptimizedWavelengths(made.distribution)};
    write_color_bar(arguments.color_bar, samplers, lamp);
  }
  if (!arguments.json.empty()) write_json(arguments, made);
  if (!arguments.quiet) print_result(made.distribution, made.seconds);
  return kExitDone;
}

}  // namespace photopic
