#include <fmt/format.h>

#include <string>

#include "core/gltf/member_checks.h"

namespace photopic {
namespace {

double number(const Place& at, const char* key, double otherwise) {
  return at.has(key) ? at.value.at(key).get<double>() : otherwise;
}

/// A camera's type names the member that describes it.
void check_camera(const Place& at) {
  const auto type = at.value.at("type").get<std::string>();
  if (!at.has(type.c_str())) at.fail(fmt::format("\"{}\" is missing", type));
  const Place lens = at.member(type);
  for (const char* key : {"xmag", "ymag"})
    if (lens.has(key) && number(lens, key, 1) == 0) lens.member(key).fail("this must not be 0");
  if (lens.has("zfar") && !(number(lens, "zfar", 0) > number(lens, "znear", 0)))
    lens.member("zfar").fail("this must be greater than znear");
}

void check_light(const Place& at) {
  if (at.value.at("type") != "spot") return;
  if (!at.has("spot")) at.fail("\"spot\" is missing");
  const Place spot = at.member("spot");
  constexpr double kDefaultOuter = 0.7853981633974483;  // π/4
  const double inner = number(spot, "innerConeAngle", 0),
               outer = number(spot, "outerConeAngle", kDefaultOuter);
  if (inner > outer)  // equal ones the specification forbids too, but what they mean is clear
    spot.fail(fmt::format("the innerConeAngle {} is larger than the outerConeAngle {}", inner, outer));
}

void check_image(const Place& at) {
  if (at.has("uri") == at.has("bufferView"))
    at.fail(at.has("uri") ? "it has both a uri and a bufferView" : "it has neither uri nor bufferView");
}

}  // namespace

void check_objects(const Place& root) {
  for_each_in(root, "cameras", check_camera);
  for_each_in(root, "images", check_image);
  for_extension(root, "KHR_lights_punctual",
                [](const Place& lights) { for_each_in(lights, "lights", check_light); });
}

}  // namespace photopic
