#include "sampler_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "distribution_cache.h"
#include "error.h"
#include "input_file.h"
#include "interrupt.h"
#include "messages.h"
#include "spectral/lamp_set.h"

namespace photopic {
namespace {

/// The value that stands beside the name. The command line lets no other name pass.
template <typename T>
T named(std::string_view name, std::initializer_list<std::pair<std::string_view, T>> values) {
  for (const auto& [known, value] : values)
    if (name == known) return value;
  throw std::logic_error(fmt::format("the name {} is not known", name));
}

Objective objective_named(std::string_view name) {
  return named<Objective>(name,
                          {{"asymptotic", Objective::asymptotic}, {"mean-delta-e", Objective::mean_delta_e}});
}
Effort effort_named(std::string_view name) {
  return named<Effort>(
      name, {{"quick", Effort::quick}, {"default", Effort::normal}, {"thorough", Effort::thorough}});
}
White white_named(std::string_view name) {
  return named<White>(name, {{"D65", White::d65}, {"illuminant", White::illuminant}});
}

/// A scene's lamps as `photopic optimize` takes them, so far as they have a spectrum that it can read.
std::string lamp_names(const PreparedScene& scene) {
  const std::vector<double>& powers = scene.lights.power_of_spectrum();
  const double strongest = powers.empty() ? 0.0 : *std::max_element(powers.begin(), powers.end());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    const std::string& name = scene.scene.emission_names[i];
    if (powers[i] > 0.0)
      names.push_back(powers[i] == strongest ? name : fmt::format("{}*{:.7g}", name, powers[i] / strongest));
  }
  return fmt::format("{}", fmt::join(names, " "));
}

/// A file that can be read leaves no gap from 360 to 830 nm, so that it is unbiased under any lamp. That it
/// is as good as one made for the scene only its own lamps let expect.
void warn_of_other_lamps(const WavelengthDistribution& distribution, std::span<const TabulatedSpectrum> lamps,
                         const DistributionRequest& request) {
  if (distribution.spectrum_digest == digest(lamps)) return;
  constexpr std::size_t kLongest = 200;
  print_warning(fmt::format(
      "{}: was made for another lamp or other powers ({}) than the scene's ({}): still unbiased, but noisier "
      "than one made for this scene, and maybe than --sampler uniform; without --distribution one is made",
      request.file.string(), distribution.spectrum.substr(0, kLongest), request.lamps.substr(0, kLongest)));
}

ChosenSampler optimized_sampler(const PreparedScene& scene, const DistributionRequest& request) {
  const std::vector<TabulatedSpectrum> lamps = scene_lamps(scene);
  if (request.file.empty()) {
    const WavelengthDistribution cached =
        cached_distribution(lamps, request.lamps, request.optimize, request.use_cache, request.quiet);
    return {OptimizedWavelengths(cached), cached.optimize_seconds};
  }
  const WavelengthDistribution distribution = read_distribution(request.file);
  warn_of_other_lamps(distribution, lamps, request);
  return {OptimizedWavelengths(distribution), distribution.optimize_seconds};
}

}  // namespace

OptimizeOptions optimize_options(int wavelengths, std::string_view objective, std::string_view effort,
                                 std::string_view white, std::uint32_t seed) {
  OptimizeOptions options;
  options.wavelengths = wavelengths;
  options.objective = objective_named(objective);
  options.effort = effort_named(effort);
  options.white = white_named(white);
  options.seed = seed;
  options.stop = &interrupt_flag();
  return options;
}

DistributionRequest distribution_request(const SceneArguments& arguments, const PreparedScene& scene,
                                         int wavelengths, std::string_view white) {
  const OptimizeArguments standard;  // what `photopic optimize` does when not told otherwise
  return {
      .lamps = lamp_names(scene),
      .file = arguments.distribution,
      .optimize = optimize_options(wavelengths, standard.objective, standard.effort, white, standard.seed),
      .use_cache = !arguments.no_cache,
      .quiet = arguments.quiet};
}

int choose_wavelength_count(int asked, const std::filesystem::path& distribution) {
  if (distribution.empty()) return asked > 0 ? asked : 4;
  check_readable_file(distribution);
  const int count = static_cast<int>(read_distribution(distribution).components.size());
  if (count != 1 && count != 4 && count != 8 && count != 16)
    throw InputError(distribution.string(), fmt::format("holds {} wavelengths a path", count),
                     "renders take 1, 4, 8 or 16: optimise for one of these");
  if (asked > 0 && asked != count)
    throw InputError(distribution.string(), fmt::format("holds {} wavelengths a path, not {}", count, asked),
                     fmt::format("leave out --wavelengths {} or optimise for that number", asked));
  return count;
}

ChosenSampler choose_sampler(std::string_view name, const PreparedScene& scene,
                             const DistributionRequest& request) {
  const int count = request.optimize.wavelengths;
  if (name == "uniform") return {UniformWavelengths{count}, 0.0};
  if (name == "visible") return {VisibleWavelengths{count}, 0.0};
  if (name == "illuminant") return {IlluminantWavelengths{count, base_density(scene_emission(scene))}, 0.0};
  if (name == "optimized") return optimized_sampler(scene, request);
  throw std::logic_error(fmt::format("there is no sampler {}", name));
}

}  // namespace photopic
