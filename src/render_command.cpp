#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "commands.h"
#include "crop.h"
#include "error.h"
#include "interrupt.h"
#include "output_file.h"
#include "render_layers.h"
#include "run_report.h"
#include "sampler_choice.h"
#include "scene_setup.h"
#include "stopwatch.h"
#include "white_balance.h"

namespace photopic {
namespace {

/// Wall-clock seconds of everything but the render itself.
struct PhaseTimes {
  double load = 0, prepare = 0, optimize = 0, layers = 0, write = 0;
};

/// @return what will be written
std::vector<std::filesystem::path> check_outputs(const RenderArguments& arguments) {
  for (const auto& output : arguments.outputs) check_writable_image(output);
  if (!arguments.json.empty()) check_writable_file(arguments.json);
  std::vector<std::filesystem::path> outputs = arguments.outputs;
  outputs.push_back(arguments.json);
  const auto check_exr = [&](const char* option, bool given, const char* what) {
    if (given && std::ranges::none_of(arguments.outputs, is_exr))
      throw InputError(option, fmt::format("no output is an .exr, which alone can hold {}", what),
                       "add -o NAME.exr");
  };
  check_exr("--color xyz", arguments.color == "xyz", "CIE XYZ");
  check_exr("--aov", !arguments.aovs.empty(), "layers");
  check_exr("--spectral-bins", arguments.spectral_bins > 0, "spectra");
  std::vector<std::filesystem::path> inputs = input_files(arguments.scene);
  inputs.push_back(arguments.white_balance);
  check_no_overwriting(outputs, inputs);
  return outputs;
}

void warn_of_idle_options(const RenderArguments& arguments) {
  if (arguments.scene.exposure != 0.0 && std::ranges::all_of(arguments.outputs, is_float_image))
    print_warning("--exposure has no effect: no output is a .png or .jpg");
  if (!arguments.white_balance.empty() && arguments.color == "xyz" &&
      std::ranges::all_of(arguments.outputs, is_exr))
    print_warning("--white-balance has no effect: --color xyz is without it");
}

void write_json(const RenderArguments& arguments, const Scene& scene, const Run& run,
                const PhaseTimes& times) {
  nlohmann::ordered_json json = run_json(run);
  json["version"] = PHOTOPIC_VERSION;
  json["interrupted"] = run.stats.stopped;
  json["resolution"] = {scene.camera.width, scene.camera.height};
  json["crop"] = crop_json(parse_crop(arguments.scene.crop));
  json["scene"] = scene_json(arguments.scene, scene);
  json["scene"].update({{"triangles", scene.geometry.triangles.size()},
                        {"shapes", scene.geometry.shapes.size()},
                        {"materials", scene.materials.size()},
                        {"spectra", scene.emission_names}});
  json.update(settings_json(arguments.scene, arguments.white_balance));
  json["aov"] = arguments.aovs;
  json["spectral_bins"] = arguments.spectral_bins;
  json["rays"] = run.stats.rays;
  json["shadow_rays"] = run.stats.shadow_rays;
  json["phase_seconds"] = {{"load", times.load},         {"prepare", times.prepare},
                           {"optimize", times.optimize}, {"render", run.render_seconds},
                           {"layers", times.layers},     {"write", times.write}};
  write_json_file(arguments.json, json);
}

std::string format_stats(const Scene& scene, const Run& run, const PhaseTimes& times) {
  std::string text;
  const auto add = [&]<typename... T>(fmt::format_string<T...> format, T&&... values) {
    text += fmt::format(format, std::forward<T>(values)...);
  };
  const double paths = static_cast<double>(run.stats.paths);
  add("scene:    {} triangles, {} shapes, {} materials; lamps: {}\n", scene.geometry.triangles.size(),
      scene.geometry.shapes.size(), scene.materials.size(),
      without_controls(fmt::format("{}", fmt::join(scene.emission_names, ", "))));
  add("samples:  {}, {:.4g} a pixel, of {} wavelengths each; {} not finite\n", run.stats.paths, run.mean_spp,
      run.wavelengths, format_non_finite(run.stats));
  if (run.stats.expected_delta_e)
    add("error:    a mean ΔE of {:.3g} is expected\n", *run.stats.expected_delta_e);
  if (run.stats.split_paths > 0)
    add("dispersion: {:.2f} % of the samples went on with one wavelength\n",
        100.0 * static_cast<double>(run.stats.split_paths) / paths);
  if (run.stats.media_overflows > 0)
    add("media:    {} paths met more than 8 glasses at once; the outermost were forgotten\n",
        run.stats.media_overflows);
  if (run.stats.media_slips > 0)
    add("media:    {:.2g} % of the samples left a glass that they had not entered{}\n",
        100.0 * static_cast<double>(run.stats.media_slips) / paths,
        1000 * run.stats.media_slips > run.stats.paths ? ": is its mesh closed?" : ", past an edge");
  add("rays:     {:.2f} + {:.2f} shadow rays a sample\n", static_cast<double>(run.stats.rays) / paths,
      static_cast<double>(run.stats.shadow_rays) / paths);
  add("speed:    {:.3f} M samples/s, {:.3f} M rays/s\n", run.samples_per_second() * 1e-6,
      run.rays_per_second() * 1e-6);
  add("seconds:  load {:.3f}, prepare {:.3f}, optimise {:.3f}, render {:.3f}, layers {:.3f}, write {:.3f}\n",
      times.load, times.prepare, times.optimize, run.render_seconds, times.layers, times.write);
  add("means:    {}\n", format_means(run));
  return text;
}

void write_images(const RenderArguments& arguments, const Film& film, const ChromaticAdaptation& adaptation,
                  const Scene& scene, const Run& run, const std::vector<ImageLayer>& layers,
                  OutputAttempts& attempt) {
  const std::optional<PixelWindow> window = parse_crop(arguments.scene.crop);
  for (const auto& output : arguments.outputs) {
    const bool xyz = arguments.color == "xyz" && is_exr(output);
    attempt(output, [&] {
      Image image = xyz ? film.to_xyz() : film.to_linear_srgb(adaptation);
      if (window) place_in(*window, scene.camera, image);
      write_render(output, image, arguments.scene, scene, run, arguments.white_balance, layers);
    });
  }
}

int interrupted_early() {
  print_warning("interrupted before the first sample: nothing is written");
  return interrupted_exit_code();
}

}  // namespace

int run_render(const RenderArguments& arguments) {
  interrupt_flag();  // from here on Ctrl-C keeps what is done
  const SceneArguments& options = arguments.scene;
  const std::vector<std::filesystem::path> outputs = check_outputs(arguments);
  if (!options.distribution.empty() && arguments.sampler != "optimized")
    throw InputError("--distribution", "is for the optimised sampler alone",
                     "leave it out or use --sampler optimized");
  const std::optional<PixelWindow> window = parse_crop(options.crop);
  warn_of_idle_options(arguments);
  const int wavelengths = choose_wavelength_count(options.wavelengths, options.distribution);

  PhaseTimes times;
  const Stopwatch load_watch;
  Scene loaded = load_scene(options, outputs);
  if (window) check_crop(*window, loaded.camera);
  times.load = load_watch.seconds();
  const Stopwatch prepare_watch;
  const PreparedScene scene(std::move(loaded));
  times.prepare = prepare_watch.seconds();

  const ChromaticAdaptation adaptation =
      white_balance(arguments.white_balance, standard_observer(options), scene);

  LayerFilms films(arguments, scene.scene.camera);

  const Stopwatch optimize_watch;
  const ChosenSampler chosen =
      choose_sampler(arguments.sampler, scene, distribution_request(options, scene, wavelengths, "D65"));
  times.optimize = optimize_watch.seconds();
  if (interrupt_flag()) return interrupted_early();
  const RenderResult result = render_with_progress("rendering", scene, chosen.sampler, options, options.spp,
                                                   options.seed, films.to_feed(), window);
  if (result.stats.paths == 0) return interrupted_early();

  const std::optional<Film> part = window ? std::optional(result.film.cropped(*window)) : std::nullopt;
  const Film& film = part ? *part : result.film;
  Run run = make_run(arguments.sampler, options.spp, wavelengths, options.seed, film, result.stats);
  if (options.seconds > 0 || options.target_error > 0) run.spp = static_cast<int>(std::lround(run.mean_spp));
  run.optimize_seconds = chosen.optimize_seconds;
  run.image = arguments.outputs.front().string();
  OutputAttempts attempt;
  const Stopwatch layer_watch;
  std::vector<ImageLayer> layers;
  attempt("--aov", [&] { layers = make_layers(arguments, scene, result.film, films, adaptation); });
  if (window) crop_layers(*window, scene.scene.camera, layers);
  times.layers = layer_watch.seconds();
  const Stopwatch write_watch;
  write_images(arguments, film, adaptation, scene.scene, run, layers, attempt);
  times.write = write_watch.seconds();

  if (!arguments.json.empty())
    attempt(arguments.json, [&] { write_json(arguments, scene.scene, run, times); });
  if (options.target_error > 0 && run.mean_spp < kFirstLook && !run.stats.stopped)
    print_warning(fmt::format("--target-error was not judged: that takes {} samples a pixel, not {:.4g}",
                              kFirstLook, run.mean_spp));
  const bool report = prints_report(options.quiet, arguments.json);
  if (options.stats && prints_report(false, arguments.json))
    print_out(format_stats(scene.scene, run, times));
  else if (run.stats.expected_delta_e && report)
    print_out(fmt::format("a mean ΔE of {:.3g} is expected, after {:.4g} samples a pixel\n",
                          *run.stats.expected_delta_e, run.mean_spp));
  if (!result.stats.stopped) return attempt.exit_code(kExitDone);
  print_warning("interrupted: the image holds the samples done so far");
  return attempt.exit_code(interrupted_exit_code());
}

}  // namespace photopic
