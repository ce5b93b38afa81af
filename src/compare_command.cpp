#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "comparison.h"
#include "error.h"
#include "interrupt.h"
#include "optimize_run.h"
#include "output_file.h"
#include "sampler_choice.h"
#include "scene_setup.h"
#include "white_balance.h"

namespace photopic {
namespace {

/// Between the reference's seeds and the runs'.
constexpr std::uint32_t kReferenceSeedDistance = 0x9e3779b9;

/// One sampler under test.
struct Entry {
  std::string name;
  ChosenSampler chosen;
  std::uint32_t seed = 0;
  std::vector<double> seconds;  ///< of each round
  std::optional<RenderResult> result;
};

/// What all renders of a comparison share.
struct Setting {
  const CompareArguments& arguments;
  const PreparedScene& scene;
  int wavelengths;
  Xyz white;
  ChromaticAdaptation adaptation;  ///< from the observer's D65
  DistributionRequest request;

  Image develop(const Film& film) const { return film.to_linear_srgb(adaptation); }
};

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

Image average(const Image& a, const Image& b) {
  Image mean = a;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
  return mean;
}

Reference read_reference(const Setting& setting) {
  Reference reference;
  reference.file = reference.description = setting.arguments.reference.string();
  reference.image = read_image(setting.arguments.reference);
  const Camera& camera = setting.scene.scene.camera;
  check_same_size(Image(camera.width, camera.height), reference.image, reference.file);
  return reference;
}

/// Two renders of half the samples each, averaged. Their errors are independent and each is √2 times the
/// average's, so they are about twice the average's error apart: half their mean ΔE estimates it.
/// @return nothing when interrupted
std::optional<Reference> render_reference(const Setting& setting, const WavelengthSampler& sampler) {
  const SceneArguments& options = setting.arguments.scene;
  const int asked = setting.arguments.reference_spp;
  const int half = asked > 0 ? (asked + 1) / 2 : std::max(512, 8 * std::min(options.spp, 1 << 20));

  std::vector<Image> halves;
  Reference reference;
  for (std::uint32_t i = 1; i <= 2; ++i) {
    const RenderResult result =
        render_with_progress(fmt::format("reference, half {}", i), setting.scene, sampler, options, half,
                             options.seed + i * kReferenceSeedDistance);
    if (result.stats.stopped) return std::nullopt;
    halves.push_back(setting.develop(result.film));
    reference.render_seconds += result.stats.seconds;
  }
  reference.spp = 2 * half;
  reference.description = fmt::format("optimized, {} spp", reference.spp);
  reference.image = average(halves[0], halves[1]);
  reference.own_error = 0.5 * compare_images(halves[0], halves[1], setting.white).mean_delta_e;
  return reference;
}

std::vector<Entry> choose_samplers(const Setting& setting) {
  std::vector<Entry> entries;
  for (const std::string& name : setting.arguments.samplers) {
    const auto same = [&](const Entry& entry) { return entry.name == name; };
    if (std::any_of(entries.begin(), entries.end(), same))
      throw InputError("--samplers", "names " + name + " twice", "name each once");
    const auto seed = setting.arguments.scene.seed + static_cast<std::uint32_t>(entries.size());
    entries.push_back({name, choose_sampler(name, setting.scene, setting.request), seed, {}, {}});
  }
  return entries;
}

/// Renders all samplers in turn, `repeat` times, so that slow changes of the machine's speed meet all alike.
/// @return whether it came to its end; an interrupted entry of the first round has no result
bool render_rounds(const Setting& setting, std::vector<Entry>& entries) {
  const SceneArguments& options = setting.arguments.scene;
  for (int round = 0; round < setting.arguments.repeat; ++round) {
    for (Entry& entry : entries) {
      RenderResult result = render_with_progress(entry.name, setting.scene, entry.chosen.sampler, options,
                                                 options.spp, entry.seed);
      if (result.stats.stopped) return false;
      entry.seconds.push_back(result.stats.seconds);
      if (!entry.result) entry.result.emplace(std::move(result));
    }
  }
  return true;
}

double median_time_ratio(const Entry& first, const Entry& entry) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < entry.seconds.size(); ++i)
    ratios.push_back(entry.seconds[i] / first.seconds[i]);
  return median(std::move(ratios));
}

/// The quietest sampler; optimised once where it is also under test.
WavelengthSampler reference_sampler(const Setting& setting, const std::vector<Entry>& entries) {
  for (const Entry& entry : entries)
    if (entry.name == "optimized") return entry.chosen.sampler;
  return choose_sampler("optimized", setting.scene, setting.request).sampler;
}

Run measure(const Setting& setting, const Reference& reference, const Entry& first, const Entry& entry) {
  Run run = make_run(entry.name, setting.arguments.scene.spp, setting.wavelengths, entry.seed, *entry.result);
  run.render_seconds = median(entry.seconds);
  run.time_ratio = median_time_ratio(first, entry);
  run.optimize_seconds = entry.chosen.optimize_seconds;
  run.metrics = compare_images(reference.image, setting.develop(entry.result->film), setting.white);
  if (!setting.arguments.report.empty())
    run.image = (setting.arguments.report / (entry.name + ".exr")).string();
  return run;
}

/// @param run the entry's, which is a point of the curve where its number of samples is asked for
/// @return nothing when interrupted
std::optional<ErrorCurve> measure_curve(const Setting& setting, const Reference& reference,
                                        const Entry& entry, const Run& run) {
  ErrorCurve curve{.sampler = entry.name, .spp = setting.arguments.curve, .seconds = {}, .mean_delta_e = {}};
  for (int spp : curve.spp) {
    if (spp == run.spp) {
      curve.seconds.push_back(run.render_seconds);
      curve.mean_delta_e.push_back(run.metrics->mean_delta_e);
      continue;
    }
    const RenderResult result =
        render_with_progress(fmt::format("{}, {} spp", entry.name, spp), setting.scene, entry.chosen.sampler,
                             setting.arguments.scene, spp, entry.seed);
    if (result.stats.stopped) return std::nullopt;
    const Image image = setting.develop(result.film);
    curve.seconds.push_back(result.stats.seconds);
    curve.mean_delta_e.push_back(compare_images(reference.image, image, setting.white).mean_delta_e);
  }
  return curve;
}

/// As EXR and as PNG.
void write_pair(const Setting& setting, const std::string& name, const Image& image, const Run& run,
                OutputAttempts& attempt) {
  for (const char* ending : {".exr", ".png"})
    attempt([&] {
      write_render(setting.arguments.report / (name + ending), image, setting.arguments.scene,
                   setting.scene.scene, run);
    });
}

void write_reference(const Setting& setting, Reference& reference, OutputAttempts& attempt) {
  Run run;
  run.sampler = "optimized";
  run.spp = reference.spp;
  run.mean_spp = reference.spp;
  run.wavelengths = setting.wavelengths;
  run.seed = setting.arguments.scene.seed + kReferenceSeedDistance;
  run.render_seconds = reference.render_seconds;
  write_pair(setting, "reference", reference.image, run, attempt);
  reference.file = (setting.arguments.report / "reference.exr").string();
}

void write_report(const Setting& setting, const std::vector<Entry>& entries, Comparison& comparison,
                  OutputAttempts& attempt) {
  const std::filesystem::path& folder = setting.arguments.report;
  std::error_code ignored;
  attempt([&] { std::filesystem::create_directories(folder); });
  if (!std::filesystem::is_directory(folder, ignored)) return;
  std::vector<WavelengthSampler> samplers;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const Run& run = comparison.runs[i];
    write_pair(setting, run.sampler, setting.develop(entries[i].result->film), run, attempt);
    samplers.push_back(entries[i].chosen.sampler);
  }
  attempt([&] { write_color_bar(folder / "color-bars.png", samplers, scene_emission(setting.scene)); });
  if (comparison.reference.spp > 0) write_reference(setting, comparison.reference, attempt);
  attempt([&] { write_file(folder / "comparison.txt", format_comparison(comparison)); });
}

void write_json(const CompareArguments& arguments, const Camera& camera, const Comparison& comparison) {
  nlohmann::ordered_json json = comparison_json(comparison);
  json["scene"] = {{"file", arguments.scene.scene.string()}, {"resolution", {camera.width, camera.height}}};
  write_json_file(arguments.json, json);
}

void warn_of_reference(const std::filesystem::path& file, const std::vector<Entry>& entries) {
  const Metadata reference = read_metadata(file);
  for (const Entry& entry : entries)
    warn_of_shared_noise(reference, entry.name,
                         {{"sampler", entry.name}, {"seed", std::to_string(entry.seed)}});
}

Comparison compare(const Setting& setting, std::vector<Entry>& entries) {
  Comparison comparison;
  comparison.white = setting.arguments.white;
  auto reference = setting.arguments.reference.empty()
                       ? render_reference(setting, reference_sampler(setting, entries))
                       : read_reference(setting);
  if (!setting.arguments.reference.empty()) warn_of_reference(setting.arguments.reference, entries);
  comparison.interrupted = !reference || !render_rounds(setting, entries);
  if (!reference) return comparison;
  comparison.reference = std::move(*reference);
  for (const Entry& entry : entries)
    if (entry.result)
      comparison.runs.push_back(measure(setting, comparison.reference, entries.front(), entry));
  if (setting.arguments.curve.empty()) return comparison;
  for (std::size_t i = 0; i < entries.size() && !comparison.interrupted; ++i) {
    auto curve = measure_curve(setting, comparison.reference, entries[i], comparison.runs[i]);
    comparison.interrupted = !curve;
    if (curve) comparison.curves.push_back(std::move(*curve));
  }
  return comparison;
}

}  // namespace

int run_compare(const CompareArguments& arguments) {
  interrupt_flag();  // from here on Ctrl-C keeps what is done
  const std::vector<std::filesystem::path> outputs = check_outputs(arguments);
  const int wavelengths = choose_wavelength_count(arguments.scene.wavelengths, arguments.scene.distribution);
  const PreparedScene scene(load_scene(arguments.scene, outputs));
  const Setting setting{arguments,
                        scene,
                        wavelengths,
                        white_point(arguments.white, scene_emission(scene)),
                        white_balance("", standard_observer(arguments.scene), scene),
                        distribution_request(arguments.scene, scene, wavelengths, arguments.white)};

  std::vector<Entry> entries = choose_samplers(setting);
  if (arguments.scene.exposure != 0.0 && arguments.report.empty())
    print_warning("--exposure has no effect without --report, whose PNG files it is for");
  Comparison comparison = compare(setting, entries);
  if (comparison.runs.empty()) {
    print_warning("interrupted before there was anything to compare");
    return interrupted_exit_code();
  }
  OutputAttempts attempt;
  if (!arguments.report.empty()) write_report(setting, entries, comparison, attempt);
  if (!arguments.json.empty()) attempt([&] { write_json(arguments, scene.scene.camera, comparison); });
  print_out(format_comparison(comparison));
  if (arguments.scene.stats)
    for (const Run& run : comparison.runs)
      print_out(fmt::format("{} means: {}\n", run.sampler, format_means(run)));
  if (!comparison.interrupted) return attempt.exit_code(kExitDone);
  print_warning("interrupted: the table holds the renders that were finished");
  return attempt.exit_code(interrupted_exit_code());
}

}  // namespace photopic
