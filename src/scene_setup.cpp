#include "scene_setup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstdio>
#include <string_view>

#include "error.h"
#include "interrupt.h"
#include "output_file.h"

namespace photopic {
namespace {

constexpr int kMaxSide = 65536;

EmitterOverride parse_emitter(const std::string& text) {
  const std::size_t equals = text.find('=');
  std::error_code error;
  if (equals == std::string::npos || std::filesystem::is_regular_file(text, error)) return {"", text};
  if (equals == 0)
    throw InputError("--emitter " + text, "the name before \"=\" is empty",
                     "write NAME=SPECTRUM, or SPECTRUM alone for all emitters");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// @return the number that is all of `text`, or 0
int parse_side(std::string_view text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end ? value : 0;
}

void parse_resolution(std::string_view text, GltfOptions& options) {
  const std::size_t x = text.find('x');
  if (x != std::string_view::npos) {
    options.width = parse_side(text.substr(0, x));
    options.height = parse_side(text.substr(x + 1));
  }
  const auto fits = [](int side) { return side >= 1 && side <= kMaxSide; };
  if (!fits(options.width) || !fits(options.height))
    throw InputError(fmt::format("--resolution {}", text), "is not a width and a height",
                     fmt::format("write it as 640x480, each 1 to {}", kMaxSide));
}

}  // namespace

std::vector<std::filesystem::path> input_files(const SceneArguments& arguments) {
  std::vector<std::filesystem::path> files{arguments.scene, arguments.distribution, arguments.environment};
  for (const std::string& text : arguments.emitters) {
    files.emplace_back(text);
    for (std::size_t at = text.find('='); at != text.npos; at = text.find('=', at + 1))
      files.emplace_back(text.substr(at + 1));  // names, too, may hold "="
  }
  return files;
}

GltfOptions gltf_options(const SceneArguments& arguments) {
  GltfOptions options;
  for (const std::string& text : arguments.emitters) options.emitters.push_back(parse_emitter(text));
  options.scene = arguments.scene_name;
  options.camera = arguments.camera;
  options.punctual_scale = arguments.punctual_scale;
  options.solid_glass = arguments.solid_glass;
  options.environment = {arguments.environment, arguments.environment_rotation,
                         arguments.environment_strength};
  if (!arguments.resolution.empty()) parse_resolution(arguments.resolution, options);
  return options;
}

Scene load_scene(const SceneArguments& arguments, const std::vector<std::filesystem::path>& outputs) {
  Scene scene = load_gltf(arguments.scene, gltf_options(arguments));
  check_no_overwriting(outputs, scene.files);
  for (const std::string& warning : scene.warnings) print_warning(warning);
  for (const auto& output : outputs) check_image_size(output, scene.camera.width, scene.camera.height);
  return scene;
}

const Observer& standard_observer(const SceneArguments& arguments) {
  return arguments.observer == 1964 ? Observer::cie1964() : Observer::cie1931();
}

Sequence sequence_of(const SceneArguments& arguments) {
  return arguments.sequence == "independent" ? Sequence::independent : Sequence::sobol;
}

RenderOptions render_options(const SceneArguments& arguments, int spp, std::uint32_t seed,
                             Progress* progress) {
  return {.spp = spp,
          .seconds = arguments.seconds,
          .target_error = arguments.target_error,
          .sequence = sequence_of(arguments),
          .observer = &standard_observer(arguments),
          .seed = seed,
          .max_depth = arguments.max_depth,
          .batch_size = arguments.batch_size,
          .stop = &interrupt_flag(),
          .progress = progress};
}

RenderResult render_with_progress(const std::string& label, const PreparedScene& scene,
                                  const WavelengthSampler& sampler, const SceneArguments& arguments, int spp,
                                  std::uint32_t seed, const FurtherFilms& further,
                                  const std::optional<PixelWindow>& window) {
  const Camera& camera = scene.scene.camera;
  const int pixels = window ? window->pixel_count() : camera.width * camera.height;
  const auto samples = std::uint64_t(pixels) * std::uint64_t(spp);
  const bool known = arguments.target_error == 0;
  RenderResult result = [&] {
    Progress progress(label, known ? samples : 0, "samples", arguments.quiet, arguments.seconds);
    RenderOptions render_as = render_options(arguments, spp, seed, &progress);
    render_as.further = further;
    render_as.window = window;
    return render(scene, sampler, render_as);
  }();
  if (result.stats.non_finite > 0)
    print_warning(fmt::format("{}: of {} samples, those not finite are left out of the image: {}", label,
                              result.stats.paths, format_non_finite(result.stats)));
  return result;
}

std::string camera_handle(const SceneArguments& arguments, const Scene& scene) {
  if (!arguments.camera.empty() || scene.camera_index < 0) return arguments.camera;
  return scene.camera_name.empty() ? fmt::format("index:{}", scene.camera_index) : scene.camera_name;
}

nlohmann::ordered_json scene_json(const SceneArguments& arguments, const Scene& scene) {
  const auto text = [](const std::string& name) {
    return name.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(name);
  };
  return {{"file", arguments.scene.string()},
          {"scene", text(scene.scene_name)},
          {"camera", text(camera_handle(arguments, scene))}};
}

nlohmann::ordered_json settings_json(const SceneArguments& arguments, const std::string& white_balance) {
  nlohmann::ordered_json json = {{"observer", fmt::format("CIE {}", arguments.observer)},
                                 {"white_balance", white_balance.empty() ? "D65" : white_balance},
                                 {"sequence", arguments.sequence},
                                 {"max_depth", arguments.max_depth},
                                 {"punctual_scale", arguments.punctual_scale},
                                 {"solid_glass", arguments.solid_glass},
                                 {"environment", nullptr},
                                 {"environment_strength", nullptr},
                                 {"environment_rotation", nullptr}};
  if (arguments.environment.empty()) return json;
  json["environment"] = arguments.environment.string();
  json["environment_strength"] = arguments.environment_strength;
  json["environment_rotation"] = arguments.environment_rotation;
  return json;
}

Metadata settings_metadata(const SceneArguments& arguments, const Scene& scene,
                           const std::string& white_balance) {
  Metadata metadata = {{"spectra", fmt::format("{}", fmt::join(scene.emission_names, ", "))}};
  const nlohmann::ordered_json settings = settings_json(arguments, white_balance);
  for (const auto& [key, value] : settings.items())
    if (!value.is_null()) metadata[key] = value.is_string() ? value.get<std::string>() : value.dump();
  return metadata;
}

void write_render(const std::filesystem::path& file, const Image& image, const SceneArguments& arguments,
                  const Scene& scene, const Run& run, const std::string& white_balance,
                  const std::vector<ImageLayer>& layers) {
  const bool linear = is_float_image(file), xyz = image.space == ColorSpace::xyz;
  Metadata metadata = settings_metadata(arguments, scene, white_balance);
  metadata.merge(Metadata{{"scene", arguments.scene.string()},
                          {"scene_of_file", scene.scene_name},
                          {"camera", camera_handle(arguments, scene)},
                          {"sampler", run.sampler},
                          {"spp", fmt::format("{:.6g}", run.mean_spp)},
                          {"wavelengths", std::to_string(run.wavelengths)},
                          {"seed", std::to_string(run.seed)},
                          {"color", !linear ? "sRGB"
                                    : xyz   ? "CIE XYZ"
                                            : "linear sRGB"},
                          {"version", "photopic " PHOTOPIC_VERSION}});
  if (linear) metadata["render_seconds"] = fmt::format("{:.3f}", run.render_seconds);
  if (!linear) metadata["exposure"] = fmt::format("{:g} EV", arguments.exposure);
  if (xyz && is_exr(file)) metadata.erase("white_balance");
  std::erase_if(metadata, [](const auto& entry) { return entry.second.empty(); });
  write_image(file, image, metadata, arguments.exposure, layers);
}

}  // namespace photopic
