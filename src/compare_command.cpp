#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "commands.h"
#include "comparison_run.h"
#include "crop.h"
#include "error.h"
#include "input_file.h"
#include "interrupt.h"
#include "optimize_run.h"
#include "output_file.h"
#include "scene_setup.h"
#include "white_balance.h"

namespace photopic {
namespace {

std::vector<std::filesystem::path> report_files(const CompareArguments& arguments) {
  std::vector<std::string> pictures = arguments.samplers;
  if (arguments.reference.empty()) pictures.emplace_back("reference");
  std::vector<std::filesystem::path> files{arguments.report / "color-bars.png",
                                           arguments.report / "comparison.txt"};
  for (const std::string& name : pictures)
    for (const char* ending : {".exr", ".png"}) files.push_back(arguments.report / (name + ending));
  return files;
}

/// @return what will be written
std::vector<std::filesystem::path> check_outputs(const CompareArguments& arguments) {
  std::vector<std::filesystem::path> outputs;
  if (!arguments.json.empty()) check_writable_file(arguments.json);
  if (!arguments.report.empty()) {
    check_writable_folder(arguments.report);
    outputs = report_files(arguments);
  }
  outputs.push_back(arguments.json);
  std::vector<std::filesystem::path> inputs = input_files(arguments.scene);
  inputs.push_back(arguments.reference);
  check_no_overwriting(outputs, inputs);
  return outputs;
}

/// As `render` refuses it: nothing would be rendered with it.
void check_distribution(const CompareArguments& arguments) {
  if (arguments.scene.distribution.empty() || arguments.reference.empty()) return;
  if (std::ranges::find(arguments.samplers, "optimized") != arguments.samplers.end()) return;
  throw InputError("--distribution", "is for the optimised sampler alone, and the reference is not rendered",
                   "leave it out or add optimized to --samplers");
}

/// As EXR and as PNG.
void write_pair(const Setting& setting, const std::string& name, const std::function<Image()>& develop,
                const Run& run, OutputAttempts& attempt) {
  for (const char* ending : {".exr", ".png"}) {
    const std::filesystem::path file = setting.arguments.report / (name + ending);
    attempt(file,
            [&] { write_render(file, develop(), setting.arguments.scene, setting.scene.scene, run, ""); });
  }
}

void write_reference(const Setting& setting, Reference& reference, OutputAttempts& attempt) {
  Run run;
  run.sampler = "optimized";
  run.spp = reference.spp;
  run.mean_spp = reference.spp;
  run.wavelengths = setting.wavelengths;
  run.seed = reference_seed(setting);
  run.render_seconds = reference.render_seconds;
  write_pair(
      setting, "reference", [&] { return reference.image; }, run, attempt);
  reference.file = (setting.arguments.report / "reference.exr").string();
}

/// @return whether it is there
bool make_folder(const std::filesystem::path& folder, OutputAttempts& attempt) {
  std::error_code ignored;
  attempt(folder, [&] { std::filesystem::create_directories(folder); });
  return std::filesystem::is_directory(folder, ignored);
}

void write_report(const Setting& setting, const std::vector<Entry>& entries, Comparison& comparison,
                  OutputAttempts& attempt) {
  const std::filesystem::path& folder = setting.arguments.report;
  if (!make_folder(folder, attempt)) return;
  std::vector<WavelengthSampler> samplers;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const Run& run = comparison.runs[i];
    write_pair(
        setting, run.sampler, [&] { return setting.develop(entries[i].result->film); }, run, attempt);
    samplers.push_back(entries[i].chosen.sampler);
  }
  const std::filesystem::path bars = folder / "color-bars.png", table = folder / "comparison.txt";
  attempt(bars, [&] { write_color_bar(bars, samplers, scene_emission(setting.scene)); });
  if (comparison.reference.spp > 0) write_reference(setting, comparison.reference, attempt);
  attempt(table, [&] { write_file(table, format_comparison(comparison)); });
}

void write_json(const CompareArguments& arguments, const Scene& scene, const Comparison& comparison) {
  nlohmann::ordered_json json = comparison_json(comparison);
  json["scene"] = scene_json(arguments.scene, scene);
  json["scene"]["resolution"] = {scene.camera.width, scene.camera.height};
  json.update(settings_json(arguments.scene, ""));
  json["scene"]["crop"] = crop_json(parse_crop(arguments.scene.crop));
  write_json_file(arguments.json, json);
}

/// Before the first run was done. A rendered reference, the dearest part, is kept where there is a report.
int interrupted_early(const Setting& setting, Reference& reference) {
  OutputAttempts attempt;
  const std::filesystem::path& folder = setting.arguments.report;
  if (reference.spp > 0 && !folder.empty() && make_folder(folder, attempt)) {
    write_reference(setting, reference, attempt);
    print_warning("interrupted: the report holds the reference alone; go on with --reference " +
                  reference.file);
  } else {
    print_warning("interrupted before there was anything to compare");
  }
  return attempt.exit_code(interrupted_exit_code());
}

}  // namespace

int run_compare(const CompareArguments& arguments) {
  interrupt_flag();  // from here on Ctrl-C keeps what is done
  if (!arguments.reference.empty()) check_readable_file(arguments.reference);
  const std::vector<std::filesystem::path> outputs = check_outputs(arguments);
  check_distribution(arguments);
  const std::optional<PixelWindow> window = parse_crop(arguments.scene.crop);
  const int wavelengths = choose_wavelength_count(arguments.scene.wavelengths, arguments.scene.distribution);
  Scene loaded = load_scene(arguments.scene, outputs);
  if (window) check_crop(*window, loaded.camera);
  const PreparedScene scene(std::move(loaded));
  const auto request = distribution_request(arguments.scene, scene, wavelengths, arguments.white);
  const Setting setting{arguments,
                        scene,
                        wavelengths,
                        white_of(request.optimize.white, scene_emission(scene)),
                        white_balance("", standard_observer(arguments.scene), scene),
                        request,
                        window};

  std::vector<Entry> entries = choose_samplers(setting);
  if (arguments.scene.exposure != 0.0 && arguments.report.empty())
    print_warning("--exposure has no effect without --report, whose PNG files it is for");
  Comparison comparison = compare(setting, entries);
  if (comparison.runs.empty()) return interrupted_early(setting, comparison.reference);
  OutputAttempts attempt;
  if (!arguments.report.empty()) write_report(setting, entries, comparison, attempt);
  if (!arguments.json.empty())
    attempt(arguments.json, [&] { write_json(arguments, scene.scene, comparison); });
  if (prints_report(arguments.scene.quiet, arguments.json)) print_out(format_comparison(comparison));
  if (arguments.scene.stats && prints_report(false, arguments.json))
    for (const Run& run : comparison.runs)
      print_out(fmt::format("{} means: {}\n", run.sampler, format_means(run)));
  if (!comparison.interrupted) return attempt.exit_code(kExitDone);
  print_warning("interrupted: the table holds the renders that were finished");
  return attempt.exit_code(interrupted_exit_code());
}

}  // namespace photopic
