#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "core/gltf/member_checks.h"
#include "spectral/spectrum_readers.h"

namespace photopic {
namespace {

double number(const JsonPlace& at, const char* key, double otherwise) {
  return at.has(key) ? at.value.at(key).get<double>() : otherwise;
}

/// A camera's type names the member that describes it.
void check_camera(const JsonPlace& at) {
  const auto type = at.value.at("type").get<std::string>();
  if (!at.has(type.c_str())) at.fail(fmt::format("\"{}\" is missing", type));
  const JsonPlace lens = at.member(type);
  for (const char* key : {"xmag", "ymag"})
    if (lens.has(key) && number(lens, key, 1) == 0) lens.member(key).fail("this must not be 0");
  if (lens.has("zfar") && !(number(lens, "zfar", 0) > number(lens, "znear", 0)))
    lens.member("zfar").fail("this must be greater than znear");
}

void check_light(const JsonPlace& at) {
  if (at.value.at("type") != "spot") return;
  if (!at.has("spot")) at.fail("\"spot\" is missing");
  const JsonPlace spot = at.member("spot");
  constexpr double kDefaultOuter = 0.7853981633974483;  // π/4
  const double inner = number(spot, "innerConeAngle", 0),
               outer = number(spot, "outerConeAngle", kDefaultOuter);
  if (inner > outer)  // equal ones the specification forbids too, but what they mean is clear
    spot.fail(fmt::format("the innerConeAngle {} is larger than the outerConeAngle {}", inner, outer));
}

void check_image(const JsonPlace& at) {
  if (at.has("uri") == at.has("bufferView"))
    at.fail(at.has("uri") ? "it has both a uri and a bufferView" : "it has neither uri nor bufferView");
}

/// A node listed twice would be drawn twice, and its lights shine twice.
void check_unique(const JsonPlace& object, const char* list) {
  std::set<std::int64_t> seen;
  for_each_in(object, list, [&](const JsonPlace& at) {
    if (!seen.insert(at.value.get<std::int64_t>()).second)
      at.fail(fmt::format("node {} stands twice in this list", at.value.get<std::int64_t>()),
              "take one of them out");
  });
}

constexpr const char* kSpectrumRemedy = "write a spectrum's name or {\"nm\": [...], \"value\": [...]}";

/// A spectrum written out.
void check_table(const JsonPlace& at) {
  const auto is_number = [](const Json& number) { return number.is_number(); };
  for (const char* key : {"nm", "value"}) {
    const bool good = at.has(key) && at.value.at(key).is_array() && !at.value.at(key).empty() &&
                      std::ranges::all_of(at.value.at(key), is_number);
    if (!good) at.fail(fmt::format("\"{}\" is not a list of numbers", key), kSpectrumRemedy);
  }
  for (const auto& [key, value] : at.value.items())
    if (key != "nm" && key != "value")
      at.fail(fmt::format("it has an unknown member \"{}\"", key.substr(0, 60)), kSpectrumRemedy);
  const auto lambda = at.value.at("nm").get<std::vector<double>>();
  const auto [shortest, longest] = std::ranges::minmax(lambda);
  const std::string problem = unit_problem(shortest, longest);
  if (!problem.empty()) at.member("nm").fail(problem, "give them in nm");
}

void check_spectrum(const JsonPlace& at) {
  if (at.value.is_string() || at.value.is_null()) return;
  if (!at.value.is_object()) at.fail("this is no spectrum", kSpectrumRemedy);
  check_table(at);
}

/// The spectra in an object's `extras`. A null or an empty list would make a wrong picture without a word:
/// tinygltf drops them.
void check_spectra(const JsonPlace& object, std::initializer_list<const char*> keys) {
  if (!object.has("extras")) return;
  const JsonPlace extras = object.member("extras");
  for (const char* key : keys)
    if (extras.has(key)) check_spectrum(extras.member(key));
}

}  // namespace

void check_objects(const JsonPlace& root) {
  for_each_in(root, "cameras", check_camera);
  for_each_in(root, "images", check_image);
  for_each_in(root, "scenes", [](const JsonPlace& scene) { check_unique(scene, "nodes"); });
  for_each_in(root, "nodes", [](const JsonPlace& node) { check_unique(node, "children"); });
  for_each_in(root, "materials", [](const JsonPlace& material) {
    check_spectra(material, {"emission_spectrum", "reflectance_spectrum"});
  });
  for_extension(root, "KHR_lights_punctual", [](const JsonPlace& lights) {
    for_each_in(lights, "lights", [](const JsonPlace& light) {
      check_light(light);
      check_spectra(light, {"emission_spectrum"});
    });
  });
}

}  // namespace photopic
