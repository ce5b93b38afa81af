#include "command_line_scene.h"

#include <fmt/format.h>

#include "command_line_lights.h"
#include "command_line_options.h"

namespace photopic {

CLI::Validator number_between(double min, double max) {
  const std::string range = fmt::format("{} to {}", min, max);
  const auto check = [min, max, range](std::string& text) {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && value >= min && value <= max;
    return good ? std::string() : "Value " + text + " is not a number from " + range;
  };
  return {check, range};
}

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
      .add_option(
          "--scene", a.scene_name,
          "The file's scene whose name is NAME, else the N-th, from 0: N, or index:N where a scene is "
          "called N. Of several with one name, the first. The file's default if not given")
      ->check(not_empty())
      ->type_name("NAME|N");
  command
      .add_option("--camera", a.camera,
                  "The camera whose name or node's name is NAME, else the N-th in the file, from 0: N, or "
                  "index:N where a camera is called N. Of several with one name, the first. The scene's "
                  "first if not given; a scene without any is framed")
      ->check(not_empty())
      ->type_name("NAME|N");
}

void bind_scene(CLI::App& command, SceneArguments& a, const std::string& served) {
  bind_scene_file(command, a);
  command
      .add_option(
          "--crop", a.crop,
          "Window to render and to write alone, of the same pixels as the whole picture's: from the top "
          "left [pixels], X1 and Y1 just outside. An EXR says where it lies. --target-error judges the tiles "
          "that its edge cuts by what is left of them: their numbers of samples may be others")
      ->check(not_empty())
      ->type_name("X0,Y0,X1,Y1");
  command.add_option("--spp", a.spp, "Samples per pixel")
      ->capture_default_str()
      ->check(samples_range())
      ->type_name("N");
  command
      .add_option("--time", a.seconds,
                  "End each render after so many seconds, scene and optimisation not counted, but not "
                  "before each pixel has a sample; without --spp as many samples as fit")
      ->check(number_between(1e-3, 1e9))
      ->type_name("SECONDS");
  command.parse_complete_callback([&a, &command] {
    const bool limited = a.seconds > 0 || a.target_error > 0;
    if (limited && command.count("--spp") == 0) a.spp = kMaxSamples;
  });
  command
      .add_option("--wavelengths", a.wavelengths,
                  "Wavelengths a path carries: 1, 4, 8 or 16; the --distribution's, else 4, if not given")
      ->check(CLI::IsMember({1, 4, 8, 16}))
      ->type_name("N");
  command
      .add_option("--distribution", a.distribution,
                  "Wavelength densities written by `photopic optimize`, of " + served +
                      ": unbiased under any lamps, least noisy under those they were made for; if not given, "
                      "this scene's are optimised on the spot and kept in $XDG_CACHE_HOME/photopic")
      ->check(not_empty())
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
      .add_option("--batch-size", a.batch_size,
                  "Paths advanced together; changes the speed, not the image, but for which of two surfaces "
                  "in exactly one place is met")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 20))
      ->type_name("N");
  command
      .add_option("--exposure", a.exposure,
                  "Exposure of PNG and JPEG files [EV, a factor of 2 each]; EXR stays as it is")
      ->capture_default_str()
      ->check(exposure_range())
      ->type_name("EV");
  command.add_flag("--stats", a.stats, "Print counts, times and channel means with their standard errors");
}

}  // namespace photopic
