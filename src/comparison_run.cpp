#include "comparison_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "crop.h"
#include "error.h"
#include "image_pair.h"
#include "scene_setup.h"

namespace photopic {
namespace {

/// Between the reference's seeds and the runs'.
constexpr std::uint32_t kReferenceSeedDistance = 0x9e3779b9;

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
  const PixelWindow part = setting.window.value_or(PixelWindow{0, 0, camera.width, camera.height});
  const ImageShape render{part.width(), part.height(), part.x0, part.y0, camera.width, camera.height};
  if (auto matching = matching_part(render, reference.image)) reference.image = *std::move(matching);
  check_same_pixels(render, reference.image, reference.file);
  return reference;
}

void warn_of_reference(const Setting& setting, const std::vector<Entry>& entries) {
  const std::filesystem::path& file = setting.arguments.reference;
  warn_of_8_bit_reference(file);
  const Metadata reference = read_metadata(file);
  const SceneArguments& options = setting.arguments.scene;
  warn_of_other_light(reference, options.scene.string(), settings_metadata(options, setting.scene.scene, ""));
  for (const Entry& entry : entries)
    warn_of_shared_noise(reference, entry.name,
                         {{"sampler", entry.name}, {"seed", std::to_string(entry.seed)}});
}

/// Renders the window alone. @param seconds 0: no limit
RenderResult render_window(const Setting& setting, const std::string& label, const WavelengthSampler& sampler,
                           int spp, double seconds, std::uint32_t seed) {
  SceneArguments options = setting.arguments.scene;
  options.seconds = seconds;
  RenderResult result =
      render_with_progress(label, setting.scene, sampler, options, spp, seed, {}, setting.window);
  if (setting.window) result.film = result.film.cropped(*setting.window);
  return result;
}

/// Two renders of half the samples each, averaged. Their errors are independent and each is √2 times the
/// average's, so they are about twice the average's error apart: half their mean ΔE estimates it.
/// @return nothing when interrupted
std::optional<Reference> render_reference(const Setting& setting, const WavelengthSampler& sampler) {
  const SceneArguments& options = setting.arguments.scene;
  const int asked = setting.arguments.reference_spp;
  const int half = asked > 0 ? (asked + 1) / 2 : std::max(512, 8 * std::min(options.spp, 1 << 20));

  const double half_seconds = asked > 0 ? 0 : 8 * options.seconds;

  std::vector<Image> halves;
  Reference reference;
  for (std::uint32_t i = 1; i <= 2; ++i) {
    const std::uint32_t seed = options.seed + i * kReferenceSeedDistance;
    const RenderResult result =
        render_window(setting, fmt::format("reference, half {}", i), sampler, half, half_seconds, seed);
    if (result.stats.stopped) return std::nullopt;
    halves.push_back(setting.develop(result.film));
    const Run run = make_run("optimized", half, setting.wavelengths, seed, result.film, result.stats);
    reference.spp += static_cast<int>(std::lround(run.mean_spp));
    reference.render_seconds += run.render_seconds;
  }
  reference.description = fmt::format("optimized, {} spp", reference.spp);
  reference.image = average(halves[0], halves[1]);
  reference.own_error = 0.5 * compare_images(halves[0], halves[1], setting.white).mean_delta_e;
  return reference;
}

/// Renders all samplers in turn, `repeat` times, so that slow changes of the machine's speed meet all alike.
/// @return whether it came to its end; an interrupted entry of the first round has no result
bool render_rounds(const Setting& setting, std::vector<Entry>& entries) {
  const SceneArguments& options = setting.arguments.scene;
  for (int round = 0; round < setting.arguments.repeat; ++round) {
    for (Entry& entry : entries) {
      RenderResult result =
          render_window(setting, entry.name, entry.chosen.sampler, options.spp, options.seconds, entry.seed);
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
  Run run = make_run(entry.name, setting.arguments.scene.spp, setting.wavelengths, entry.seed,
                     entry.result->film, entry.result->stats);
  if (setting.arguments.scene.seconds > 0) run.spp = static_cast<int>(std::lround(run.mean_spp));
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
    if (spp == run.mean_spp) {
      curve.seconds.push_back(run.render_seconds);
      curve.mean_delta_e.push_back(run.metrics->mean_delta_e);
      continue;
    }
    const RenderResult result = render_window(setting, fmt::format("{}, {} spp", entry.name, spp),
                                              entry.chosen.sampler, spp, 0.0, entry.seed);
    if (result.stats.stopped) return std::nullopt;
    const Image image = setting.develop(result.film);
    curve.seconds.push_back(result.stats.seconds);
    curve.mean_delta_e.push_back(compare_images(reference.image, image, setting.white).mean_delta_e);
  }
  return curve;
}

}  // namespace

Image Setting::develop(const Film& film) const {
  Image image = film.to_linear_srgb(adaptation);
  if (window) place_in(*window, scene.scene.camera, image);
  return image;
}

std::uint32_t reference_seed(const Setting& setting) {
  return setting.arguments.scene.seed + kReferenceSeedDistance;
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

Comparison compare(const Setting& setting, std::vector<Entry>& entries) {
  Comparison comparison;
  comparison.white = setting.arguments.white;
  comparison.timed = setting.arguments.scene.seconds > 0;
  auto reference = setting.arguments.reference.empty()
                       ? render_reference(setting, reference_sampler(setting, entries))
                       : read_reference(setting);
  if (!setting.arguments.reference.empty()) warn_of_reference(setting, entries);
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

}  // namespace photopic
