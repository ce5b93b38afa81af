#include "command_line.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "commands.h"
#include "light_options.h"

namespace photopic {
namespace {

constexpr const char* kSpectrumHelp =
    "\nSPECTRUM is a file (two columns nm, value; LSPDD .csv/.json; CGATS .sp; TM-27 .spdx), "
    "cie:A|D50|D65|E|FL1…FL12|…,\n"
    "blackbody:KELVIN, line:NM[:FWHM] or constant.";

const CLI::Range kSamplesRange(1, 1 << 24);

CLI::Validator one_of(std::vector<std::string> names) {
  return CLI::IsMember(std::move(names));
}

const CLI::Validator kFinite(
    [](std::string& text) {
      double value = 0;
      const bool number =
          CLI::detail::lexical_cast(text, value) && std::isfinite(value) && std::abs(value) <= 100;
      return number ? std::string() : "Value " + text + " is not a number from -100 to 100";
    },
    "-100…100");

/// @param served what the --distribution serves
void bind_scene(CLI::App& command, SceneArguments& a, const std::string& served) {
  command.add_option("SCENE", a.scene, "A glTF 2.0 file, .gltf or .glb")->required()->type_name("");
  bind_lights(command, a);
  command.add_option("--resolution", a.resolution, "Size of the image [pixels]; the camera's if not given")
      ->type_name("WxH");
  command.add_option("--camera", a.camera, "The camera's name; the scene's first if not given")
      ->type_name("NAME");

  command.add_option("--spp", a.spp, "Samples per pixel")
      ->capture_default_str()
      ->check(kSamplesRange)
      ->type_name("N");
  command
      .add_option("--wavelengths", a.wavelengths,
                  "Wavelengths a path carries: 1, 4, 8 or 16; the --distribution's, else 4, if not given")
      ->check(CLI::IsMember({1, 4, 8, 16}))
      ->type_name("N");
  command
      .add_option("--distribution", a.distribution,
                  "Wavelength densities written by `photopic optimize` for this scene's lamps, of " + served +
                      "; if not given, they are optimised on the spot and kept in $XDG_CACHE_HOME/photopic")
      ->type_name("FILE.json");
  command.add_flag("--no-cache", a.no_cache, "Neither read nor write that cache");
  command.add_option("--sequence", a.sequence, "Random numbers: sobol (Owen-scrambled) or independent")
      ->capture_default_str()
      ->check(one_of({"sobol", "independent"}))
      ->type_name("NAME");
  command
      .add_option("--max-depth", a.max_depth,
                  "Surfaces a path meets at most; light seen directly has depth 1")
      ->capture_default_str()
      ->check(CLI::Range(1, 65536))
      ->type_name("N");
  command
      .add_option("--batch-size", a.batch_size, "Paths advanced together; changes the speed, not the image")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 20))
      ->type_name("N");
  command
      .add_option("--exposure", a.exposure,
                  "Exposure of PNG and JPEG files [EV, a factor of 2 each]; EXR stays as it is")
      ->capture_default_str()
      ->check(kFinite)
      ->type_name("EV");
  command.add_flag("--stats", a.stats, "Print counts, times and channel means with their standard errors");
}

void bind_seed(CLI::App& command, std::uint32_t& seed) {
  command.add_option("--seed", seed, "Same seed, same bits, whatever the number of threads")
      ->capture_default_str()
      ->type_name("N");
}

void bind_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use; 0: as many as the machine runs at once")
      ->capture_default_str()
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
}

void bind_json(CLI::App& command, std::filesystem::path& json) {
  command.add_option("--json", json, "Write the result for machines to read")->type_name("FILE");
}

void bind_quiet(CLI::App& command, bool& quiet,
                const char* help = "No progress, no summary; warnings and errors only") {
  command.add_flag("--quiet", quiet, help);
}

void bind_white(CLI::App& command, std::string& white, const char* help) {
  command.add_option("--white", white, help)
      ->capture_default_str()
      ->check(one_of({"D65", "illuminant"}))
      ->type_name("NAME");
}

template <typename Arguments>
CLI::App* add_command(CLI::App& app, const char* name, const char* description, std::function<int()>& action,
                      int (*run)(const Arguments&), std::shared_ptr<Arguments> arguments) {
  CLI::App* command = app.add_subcommand(name, description);
  command->callback([&action, run, arguments] { action = [run, arguments] { return run(*arguments); }; });
  return command;
}

void bind_render(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<RenderArguments>();
  CLI::App& command = *add_command(app, "render", "Render a scene", action, run_render, a);
  bind_scene(command, a->scene, "the optimised sampler");
  command
      .add_option("-o,--output", a->outputs,
                  "Image to write: .exr .hdr (linear), .png .jpg (sRGB); may be repeated")
      ->required()
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      .add_option("--sampler", a->sampler,
                  "How wavelengths are chosen: uniform, visible, illuminant or optimized")
      ->capture_default_str()
      ->check(one_of({"uniform", "visible", "illuminant", "optimized"}))
      ->type_name("NAME");
  bind_seed(command, a->scene.seed);
  bind_threads(command, threads);
  bind_json(command, a->json);
  bind_quiet(command, a->scene.quiet);
  command.footer(std::string(kSpectrumHelp) +
                 "\n\nExample: photopic render box.gltf --emitter cie:FL11 --spp 256 -o box.exr -o box.png");
}

void bind_compare(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<CompareArguments>();
  CLI::App& command = *add_command(
      app, "compare", "Render a scene with several wavelength samplers and tabulate their errors", action,
      run_compare, a);
  bind_scene(command, a->scene, "the optimised sampler and the reference");
  command.add_option("--samplers", a->samplers, "Samplers to compare; ratios are to the first")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str()
      ->check(one_of({"uniform", "visible", "illuminant", "optimized"}))
      ->type_name("NAME,…");
  auto* reference = command.add_option("--reference", a->reference,
                                       "Linear image to measure against; rendered if not given");
  reference->type_name("FILE.exr");
  command
      .add_option("--reference-spp", a->reference_spp,
                  "Samples per pixel of the rendered reference: optimised wavelengths, seeds of its own; 16 "
                  "times --spp "
                  "and at least 1024 if not given")
      ->check(CLI::Range(2, 1 << 24))
      ->excludes(reference)
      ->type_name("N");
  command
      .add_option("--curve", a->curve, "Also measure the mean ΔE and the seconds at these samples per pixel")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(kSamplesRange)
      ->type_name("N,…");
  command
      .add_option("--repeat", a->repeat,
                  "Rounds over all samplers; times and their ratios are medians over the rounds")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  bind_white(command, a->white,
             "White of ΔE: D65, or the illuminant for an observer adapted to the scene's lamps");
  command
      .add_option("--report", a->report,
                  "Folder for each sampler's EXR and PNG, the reference's, the color bars and the table")
      ->type_name("DIR");
  bind_seed(command, a->scene.seed);
  bind_threads(command, threads);
  bind_json(command, a->json);
  bind_quiet(command, a->scene.quiet, "No progress; the table, warnings and errors only");
  command.footer(
      std::string("\nΔE is CIEDE2000 on unclipped linear images. The n-th sampler renders with seed --seed + "
                  "n, so that\n"
                  "their means are independent and can be tested against each other (largest |z|).\n") +
      kSpectrumHelp +
      "\n\nExample: photopic compare box.gltf --emitter cie:FL11 --samplers uniform,optimized --report out");
}

void bind_optimize(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<OptimizeArguments>();
  CLI::App& command = *add_command(
      app, "optimize", "Find the wavelength densities that suit a lamp, or several", action, run_optimize, a);
  command
      .add_option(
          "SPECTRUM", a->spectra,
          "The lamp's spectrum, see below; of several, one set of densities serves all. SPECTRUM*POWER "
          "gives a lamp's luminous power relative to the others', 1 if not given")
      ->required()
      ->type_name("[SPECTRUM[*POWER]…]");
  command.add_option("-o,--output", a->output, "Where the densities go, for render --distribution")
      ->required()
      ->type_name("FILE.json");
  command
      .add_option("--wavelengths", a->wavelengths,
                  "Wavelengths a path carries, 1 to 16 (render takes 1, 4, 8, 16)")
      ->capture_default_str()
      ->check(CLI::Range(1, 16))
      ->type_name("N");
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
  bind_white(command, a->white, "White of ΔE: D65, or the illuminant for an adapted observer");
  command
      .add_option("--color-bar", a->color_bar,
                  "Picture of the colours that the sampler sees, beside the other samplers'")
      ->type_name("FILE.png");
  command
      .add_option("--plot", a->plot,
                  "Picture of the spectrum, the densities, and what single paths see before and after")
      ->type_name("FILE.svg");
  bind_seed(command, a->seed);
  bind_threads(command, threads);
  bind_json(command, a->json);
  bind_quiet(command, a->quiet);
  command.footer(std::string(kSpectrumHelp) +
                 "\n\nExample: photopic optimize cie:FL11 -o fl11.json --color-bar fl11.png"
                 "\nExample: photopic optimize cie:FL11 'blackbody:2700*0.5' -o two-lamps.json");
}

void bind_spectrum(CLI::App& app, std::function<int()>& action) {
  auto a = std::make_shared<SpectrumArguments>();
  CLI::App& command = *add_command(app, "spectrum", "Describe a lamp: its colour, temperature and lines",
                                   action, run_spectrum, a);
  command.add_option("SPECTRUM", a->spectrum, "The lamp's spectrum, see below")->required()->type_name("");
  command.add_option("--plot", a->plot, "Picture of the spectrum")->type_name("FILE.svg");
  bind_json(command, a->json);
  bind_quiet(command, a->quiet);
  command.footer(
      std::string(kSpectrumHelp) +
      "\n\nChromaticity: CIE 1931. Temperature: that of the nearest blackbody [K] and the distance "
      "Duv from it.\nA line is a peak at most 12 nm wide that holds 0.2 % of the power."
      "\n\nExample: photopic spectrum cie:FL11 --plot fl11.svg");
}

void bind_diff(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<DiffArguments>();
  CLI::App& command =
      *add_command(app, "diff", "Measure how far images are from a reference", action, run_diff, a);
  command.add_option("REFERENCE", a->reference, "The image to measure against")->required()->type_name("");
  command.add_option("IMAGE", a->images, "Images of the same size")->required()->type_name("");
  bind_threads(command, threads);
  bind_json(command, a->json);
  command.footer(
      "\nΔE is CIEDE2000 on unclipped linear images, white D65 at Y = 1; 8-bit files are decoded first.\n\n"
      "Example: photopic diff reference.exr uniform.exr optimized.exr --json errors.json");
}

}  // namespace

void bind_commands(CLI::App& app, std::function<int()>& action, int& threads) {
  bind_render(app, action, threads);
  bind_optimize(app, action, threads);
  bind_compare(app, action, threads);
  bind_spectrum(app, action);
  bind_diff(app, action, threads);
}

}  // namespace photopic
