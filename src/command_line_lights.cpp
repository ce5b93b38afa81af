#include "command_line_lights.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "command_line_options.h"

namespace photopic {
namespace {

const CLI::Validator kAngle(
    [](std::string& text) {
      double value = 0;
      const bool good = CLI::detail::lexical_cast(text, value) && std::abs(value) <= 1e6;
      return good ? std::string() : "Value " + text + " is not an angle";
    },
    "degrees");
const CLI::Validator kFactor(
    [](std::string& text) {
      double value = 0;
      const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0 && value <= 1e12;
      return good ? std::string() : "Value " + text + " is not a number above 0";
    },
    "above 0");

}  // namespace

void bind_lights(CLI::App& command, SceneArguments& a) {
  command
      .add_option(
          "--emitter", a.emitters,
          "The spectrum of all emitters, or of those whose material or light is called NAME "
          "(\"environment\": that); may be repeated: NAME wins over all, later ones over earlier. NAME may "
          "hold \"=\": the longest that there is counts. Luminances stay as the scene has them")
      ->type_name("[NAME=]SPECTRUM")
      ->allow_extra_args(false);
  command
      .add_option("--punctual-scale", a.punctual_scale,
                  "Factor on the intensities of point, spot and directional lights. Blender's exporter "
                  "multiplies lamps by 683 lm/W but not emissive materials: 0.001464 balances them")
      ->capture_default_str()
      ->check(kFactor)
      ->type_name("X");
  auto* environment = command.add_option(
      "--environment", a.environment,
      "Picture of the surroundings in latitude and longitude, twice as wide as high, .exr or .hdr, its "
      "linear RGB in cd/m2 (of a .png or .jpg from 0 to 1), or a grey Y; its middle lies in the direction "
      "-z, its upper edge in +y");
  environment->check(not_empty())->type_name("FILE");
  command
      .add_option("--environment-rotation", a.environment_rotation,
                  "Turns it about +y, counter-clockwise seen from above [degrees]")
      ->capture_default_str()
      ->check(kAngle)
      ->needs(environment)
      ->type_name("DEG");
  command.add_option("--environment-strength", a.environment_strength, "Factor on its luminances")
      ->capture_default_str()
      ->check(kFactor)
      ->needs(environment)
      ->type_name("X");
}

}  // namespace photopic
