#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "command_line_lights.h"
#include "command_line_options.h"
#include "commands.h"

namespace photopic {
namespace {

constexpr int kMaxSamples = 1 << 24;
const CLI::Range kSamplesRange(1, kMaxSamples);

const CLI::Validator kFinite(
    [](std::string& text) {
      double value = 0;
      const bool number =
          CLI::detail::lexical_cast(text, value) && std::isfinite(value) && std::abs(value) <= 100;
      return number ? std::string() : "Value " + text + " is not a number from -100 to 100";
    },
    "-100…100");

/// CLI::Range lets "nan" pass.
CLI::Validator number_between(double min, double max) {
  const std::string range = fmt::format("{} to {}", min, max);
  const auto check = [min, max, range](std::string& text) {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && value >= min && value <= max;
    return good ? std::string() : "Value " + text + " is not a number from " + range;
  };
  return {check, range};
}
const CLI::Validator kSeconds = number_between(1e-3, 1e9), kDeltaE = number_between(1e-3, 1e3);

const CLI::Validator kNotEmpty(
    [](std::string& text) { return text.empty() ? std::string("it is empty") : std::string(); }, "");

/// What a scene is loaded with.
void bind_scene_file(CLI::App& command, SceneArguments& a) {
  command.add_option("SCENE", a.scene, "A glTF 2.0 file, .gltf or .glb")->required()->type_name("");
  bind_lights(command, a);
  command.add_flag(
      "--solid-glass", a.solid_glass,
      "Closed meshes that transmit are solid and refract even without KHR_materials_volume, which "
      "Blender does not write. Materials may say so by extras: {\"solid\": true}");
  command.add_option("--resolution", a.resolution, "Size of the image [pixels]; the camera's if not given")
      ->type_name("WxH");
  command
      .add_option("--camera", a.camera,
                  "The camera whose name or node's name is NAME, else the N-th in the file, from 0: N, or "
                  "index:N where a camera is called N. Of several with one name, the first. The scene's "
                  "first if not given; a scene without any is framed")
      ->check(kNotEmpty)
      ->type_name("NAME|N");
}

/// @param served what the --distribution serves
void bind_scene(CLI::App& command, SceneArguments& a, const std::string& served) {
  bind_scene_file(command, a);
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
      .add_option("--observer", a.observer,
                  "CIE standard observer: 1931 (2 degrees) or 1964 (10 degrees; D65 comes out white for "
                  "either). Luminances are 1931's")
      ->capture_default_str()
      ->check(CLI::IsMember({1931, 1964}))
      ->type_name("YEAR");
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
  command
      .add_option("--time", a->scene.seconds,
                  "End the render after so many seconds, scene and optimisation not counted; without --spp "
                  "as many samples as fit")
      ->check(kSeconds)
      ->type_name("SECONDS");
  command
      .add_option(
          "--target-error", a->scene.target_error,
          "End each 16x16 pixels when their expected mean ΔE (CIEDE2000, 0 EV) is this or less; without "
          "--spp however many samples that takes")
      ->check(kDeltaE)
      ->type_name("ΔE");
  command.parse_complete_callback([a, &command] {
    const bool limited = a->scene.seconds > 0 || a->scene.target_error > 0;
    if (limited && command.count("--spp") == 0) a->scene.spp = kMaxSamples;
  });
  command
      .add_option("--color", a->color,
                  "What an EXR holds: srgb (linear sRGB) or xyz (CIE XYZ as observed, without white balance)")
      ->capture_default_str()
      ->check(one_of({"srgb", "xyz"}))
      ->type_name("SPACE");
  command
      .add_option("--white-balance", a->white_balance,
                  "What comes out white, by Bradford adaptation: a SPECTRUM, or illuminant for the scene's "
                  "lamps; D65 if not given")
      ->type_name("SPECTRUM");
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

void bind_info(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<InfoArguments>();
  CLI::App& command = *add_command(
      app, "info", "Describe a scene: what it holds and what a render of it will use", action, run_info, a);
  bind_scene_file(command, a->scene);
  bind_threads(command, threads);
  bind_json(command, a->json);
  command.footer(
      std::string(kSpectrumHelp) +
      "\n\nLuminances are in cd/m², luminous fluxes in lm, lengths in m. Memory is an estimate.\n\n"
      "Example: photopic info box.gltf --json box.json");
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
  bind_info(app, action, threads);
  bind_optimize(app, action, threads);
  bind_compare(app, action, threads);
  bind_spectrum(app, action);
  bind_diff(app, action, threads);
}

}  // namespace photopic
