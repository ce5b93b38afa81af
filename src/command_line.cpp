#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "command_line_options.h"
#include "command_line_scene.h"
#include "commands.h"
#include "error_map.h"
#include "render_layers.h"

namespace photopic {
namespace {

void bind_layers(CLI::App& command, RenderArguments& a) {
  command
      .add_option(
          "--aov", a.aovs,
          "Layers of every EXR, of the first surface that a pixel's rays meet, glass and mirrors too: albedo "
          "(albedo.R .G .B; base colour, linear sRGB), normal (normal.X .Y .Z; of shading, world space, "
          "towards the viewer, as long as it is the same all over a pixel), depth (depth.Z; along the "
          "camera's axis [m], of the rays that meet something), alpha (alpha.A; the share of these rays); "
          "means over the pixel's first 64 samples, 0 "
          "where nothing is met. Of the picture: samples (samples.Y; their number), variance (variance.R .G "
          ".B or .X .Y .Z; of the pixel's mean, samples taken as independent: too large for --sequence "
          "sobol)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of(kAovs))
      ->type_name("NAME,…");
  command
      .add_option(
          "--spectral-bins", a.spectral_bins,
          "Every EXR holds the spectrum, too, in N equal bins over 360-830 nm, in the layout of Fichet et "
          "al. 2021: channels S0.<centre>nm, a bin's mean spectral radiance [W/(m² sr nm), where the "
          "scene's luminances are in cd/m²]. Takes about 12 bytes of memory a bin and pixel. --sampler "
          "uniform serves all bins alike")
      ->check(CLI::Range(1, kMostSpectralBins))
      ->type_name("N");
}

void bind_render(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<RenderArguments>();
  CLI::App& command = *add_command(app, "render", "Render a scene", action, run_render, a);
  bind_scene(command, a->scene, "the optimised sampler");
  command
      .add_option("-o,--output", a->outputs,
                  "Image to write: .exr .hdr (linear), .png .jpg (sRGB); may be repeated")
      ->required()
      ->check(not_empty())
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      .add_option("--sampler", a->sampler,
                  "How wavelengths are chosen: uniform, visible, illuminant or optimized")
      ->capture_default_str()
      ->check(one_of(kSamplers))
      ->type_name("NAME");
  command
      .add_option(
          "--target-error", a->scene.target_error,
          "End each 16x16 pixels when their expected mean ΔE (CIEDE2000, 0 EV) is this or less; without "
          "--spp however many samples that takes. It is first judged at 32 samples a pixel")
      ->check(number_between(1e-3, 1e3))
      ->type_name("ΔE");
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
      ->check(not_empty())
      ->type_name("SPECTRUM");
  bind_layers(command, *a);
  bind_seed(command, a->scene.seed);
  bind_threads(command, threads);
  bind_json(command, a->json);
  bind_quiet(command, a->scene.quiet);
  command.footer(std::string(kSpectrumHelp) +
                 "\n\nExample: photopic render box.gltf --emitter cie:FL11 --spp 256 -o box.exr -o box.png");
}

void bind_info(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<InfoArguments>();
  CLI::App& command = *add_command(
      app, "info", "Describe a scene: what it holds and what a render of it will use", action, run_info, a);
  bind_scene_file(command, a->scene);
  bind_threads(command, threads);
  bind_json(command, a->json);
  bind_quiet(command, a->scene.quiet, "No tables; warnings and errors only");
  command.footer(
      std::string(kSpectrumHelp) +
      "\n\nLuminances are in cd/m², luminous fluxes in lm, lengths in m. Memory is an estimate.\n\n"
      "Example: photopic info box.gltf --json box.json");
}

void bind_spectrum(CLI::App& app, std::function<int()>& action, int& threads) {
  auto a = std::make_shared<SpectrumArguments>();
  CLI::App& command = *add_command(app, "spectrum", "Describe a lamp: its colour, temperature and lines",
                                   action, run_spectrum, a);
  command.add_option("SPECTRUM", a->spectrum, "The lamp's spectrum, see below")->required()->type_name("");
  command.add_option("--plot", a->plot, "Picture of the spectrum")->check(not_empty())->type_name("FILE.svg");
  bind_threads(command, threads);
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
  command
      .add_option("IMAGE", a->images,
                  "Images of the same size; of a crop and a whole picture the crop's window is compared")
      ->required()
      ->type_name("");
  command
      .add_option("--white", a->white,
                  "White of ΔE: D65, or a SPECTRUM, the lamp's for an observer adapted to it")
      ->capture_default_str()
      ->check(not_empty())
      ->type_name("SPECTRUM");
  command
      .add_option("--exposure", a->exposure,
                  "Exposure of reference and images before ΔE [EV, a factor of 2 each]; MSE and relMSE are "
                  "without it")
      ->capture_default_str()
      ->check(exposure_range())
      ->type_name("EV");
  command
      .add_option(
          "--map", a->map,
          fmt::format("Picture of ΔE, of one IMAGE alone: .exr holds it in one channel, dE; .png shows "
                      "it from black, 0, over violet, red and yellow to white, {} and more",
                      kBrightestDeltaE))
      ->check(not_empty())
      ->type_name("FILE");
  bind_threads(command, threads);
  bind_json(command, a->json);
  bind_quiet(command, a->quiet, "No table; warnings and errors only");
  command.footer(std::string("\nΔE is CIEDE2000 on unclipped linear images, its white at Y = 1; 8-bit files "
                             "are decoded first.\n") +
                 kSpectrumHelp +
                 "\n\nExample: photopic diff reference.exr uniform.exr optimized.exr --json errors.json"
                 "\nExample: photopic diff reference.exr optimized.exr --map error.png");
}

}  // namespace

void bind_commands(CLI::App& app, std::function<int()>& action, int& threads) {
  bind_render(app, action, threads);
  bind_info(app, action, threads);
  bind_optimize(app, action, threads);
  bind_compare(app, action, threads);
  bind_spectrum(app, action, threads);
  bind_diff(app, action, threads);
}

}  // namespace photopic
