#include <CLI/CLI.hpp>
#include <memory>

#include "command_line_options.h"
#include "commands.h"

namespace photopic {

void bind_optimize(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<OptimizeArguments>();
  CLI::App& command = *add_command(
      app, "optimize", "Find the wavelength densities that suit a lamp, or several", action, run_optimize, a);
  command
      .add_option(
          "SPECTRUM", a->spectra,
          "The lamp's spectrum, see below; of several, one set of densities serves all. SPECTRUM*POWER "
          "gives a lamp's luminous power relative to the others', 1e-100 to 1e100, 1 if not given")
      ->required()
      ->type_name("[SPECTRUM[*POWER]…]");
  auto* output =
      command.add_option("-o,--output", a->output, "Where the densities go, for render --distribution");
  output->check(not_empty())->type_name("FILE.json");
  auto* wavelengths = command.add_option("--wavelengths", a->wavelengths,
                                         "Wavelengths a path carries, 1 to 16 (render takes 1, 4, 8, 16)");
  wavelengths->capture_default_str()->check(CLI::Range(1, 16))->type_name("N");
  auto* compare = command.add_flag("--compare-wavelengths", a->compare_wavelengths,
                                   "Write no densities, but print what 1, 2, 4, 8 and 16 wavelengths a path "
                                   "bring under this lamp, beside the best sampler without optimisation");
  compare->excludes(output)->excludes(wavelengths);
  command
      .add_option("--objective", a->objective,
                  "asymptotic: the error of the mean of many paths [ΔE of one]; mean-delta-e: the mean ΔE of "
                  "single paths")
      ->capture_default_str()
      ->check(one_of({"asymptotic", "mean-delta-e"}))
      ->type_name("NAME");
  command.add_option("--effort", a->effort, "How long to search: quick, default or thorough")
      ->capture_default_str()
      ->check(one_of({"quick", "default", "thorough"}))
      ->type_name("NAME");
  command
      .add_option(
          "--nodes", a->nodes,
          "Nodes of each density, 3 to 1025; 193 if not given. Fewer make a smaller file and a quicker "
          "search, and a larger error")
      ->check(CLI::Range(3, 1025))
      ->type_name("N");
  command
      .add_option(
          "--reflectances", a->reflectances,
          "Measured reflectances to optimise for, beside the built-in set: columns of text (nm, then one "
          "reflectance from 0 to 1 a column), or a CGATS .sp; for the asymptotic objective")
      ->check(not_empty())
      ->type_name("FILE");
  bind_white(command, a->white, "White of ΔE: D65, or the illuminant for an adapted observer");
  command
      .add_option(
          "--color-bar", a->color_bar,
          "Picture of the colours that the sampler sees, below the other samplers': .svg with labels, or an "
          "image, .exr .hdr .png .jpg")
      ->excludes(compare)
      ->check(not_empty())
      ->type_name("FILE");
  command
      .add_option("--plot", a->plot,
                  "Picture of the spectrum, the densities, and what single paths see before and after")
      ->excludes(compare)
      ->check(not_empty())
      ->type_name("FILE.svg");
  bind_seed(command, a->seed);
  bind_threads(command, threads);
  bind_json(command, a->json);
  bind_quiet(command, a->quiet, "No progress, no tables; warnings and errors only");
  command.footer(std::string(kSpectrumHelp) +
                 "\n\nExample: photopic optimize cie:FL11 -o fl11.json --color-bar fl11.png"
                 "\nExample: photopic optimize cie:FL11 --compare-wavelengths"
                 "\nExample: photopic optimize cie:FL11 'blackbody:2700*0.5' -o two-lamps.json");
}

}  // namespace photopic
