#include "spectral/wavelength_distribution.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "atomic_file.h"
#include "error.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 3;
constexpr const char* kFormat = "photopic wavelength distribution";

Json to_json(const WavelengthDistribution& distribution) {
  Json json;
  json["format"] = kFormat;
  json["version"] = kVersion;
  json["spectrum"] = distribution.spectrum;
  json["spectrum_digest"] = distribution.spectrum_digest;
  json["objective"] = distribution.objective;
  const WavelengthDistribution::TargetRecord& targets = distribution.targets;
  json["targets"] = {{"white", targets.white},
                     {"constructed", targets.constructed},
                     {"seed", targets.seed},
                     {"measured", targets.measured},
                     {"measured_file", targets.measured_file},
                     {"measured_digest", targets.measured_digest}};
  json["optimize_seconds"] = distribution.optimize_seconds;
  json["value"] = distribution.value;
  json["baselines"] = {{"uniform", distribution.uniform_value},
                       {"visible", distribution.visible_value},
                       {"illuminant", distribution.illuminant_value}};
  const auto x = distribution.base.x();
  const auto value = distribution.base.value();
  json["base"] = {{"nm", std::vector<double>(x.begin(), x.end())},
                  {"density", std::vector<double>(value.begin(), value.end())}};
  json["stepped"] = distribution.stepped;
  json["components"] = Json::array();
  for (const auto& component : distribution.components)
    json["components"].push_back({{"backwards", component.backwards}, {"nodes", component.nodes}});
  return json;
}

/// A value of the file together with the place where it stands, so that every complaint can name it.
class Place {
 public:
  Place(std::string file, const Json& json) : where_(std::move(file) + "#"), json_(&json) {}

  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(where_, problem, "write the file anew with 'photopic optimize'");
  }
  void only_keys(std::initializer_list<const char*> known) const {
    if (!json_->is_object()) refuse("expected an object");
    for (const auto& [key, value] : json_->items())
      if (std::find(known.begin(), known.end(), key) == known.end()) refuse("unknown key \"" + key + "\"");
  }
  Place at(const char* key) const {
    if (!json_->contains(key)) refuse("the key \"" + std::string(key) + "\" is missing");
    return {Child{}, where_ + "/" + key, json_->at(key)};
  }
  Place at(std::size_t i) const { return {Child{}, where_ + "/" + std::to_string(i), json_->at(i)}; }
  std::size_t array_size() const {
    if (!json_->is_array()) refuse("expected an array");
    return json_->size();
  }

  std::string text() const {
    if (!json_->is_string()) refuse("expected a text");
    return json_->get<std::string>();
  }
  bool truth() const {
    if (!json_->is_boolean()) refuse("expected true or false");
    return json_->get<bool>();
  }
  double number() const {
    if (!json_->is_number()) refuse("expected a number");
    const auto value = json_->get<double>();
    if (!std::isfinite(value)) refuse("the number is not finite");
    return value;
  }
  std::uint64_t count() const {
    if (!json_->is_number_unsigned()) refuse("expected a whole number");
    return json_->get<std::uint64_t>();
  }
  std::vector<double> numbers() const {
    std::vector<double> values(array_size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = at(i).number();
    return values;
  }

 private:
  struct Child {};
  Place(Child, std::string where, const Json& json) : where_(std::move(where)), json_(&json) {}
  std::string where_;
  const Json* json_;
};

/// What it leaves out no density draws.
PiecewiseLinearDensity read_base(const Place& place) {
  place.only_keys({"nm", "density"});
  std::vector<double> x = place.at("nm").numbers(), value = place.at("density").numbers();
  if (x.empty() || x.front() != kLambdaMin || x.back() != kLambdaMax)
    place.at("nm").refuse("the knots do not reach from 360 to 830 nm");
  for (std::size_t i = 0; i < value.size(); ++i)
    if (!(value[i] > 0.0)) place.at("density").at(i).refuse("a density must be positive");
  try {
    return {std::move(x), std::move(value)};
  } catch (const std::invalid_argument& problem) {
    place.refuse(problem.what());
  }
}

WavelengthDistribution::Component read_component(const Place& place, bool stepped) {
  place.only_keys({"backwards", "nodes"});
  const Place nodes = place.at("nodes");
  WavelengthDistribution::Component component{nodes.numbers(), place.at("backwards").truth()};
  const std::vector<double>& values = component.nodes;
  if (values.size() < (stepped ? 1 : 2)) nodes.refuse("a density needs more nodes");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (stepped ? !(values[i] >= 0.0) : !(values[i] > 0.0)) nodes.at(i).refuse("a node must be positive");
  if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; }))
    nodes.refuse("a density must not be zero everywhere");
  return component;
}

/// Every wavelength must be drawn by one density at least, or the estimate is biased.
void check_no_gap(const Place& place, const std::vector<WavelengthDistribution::Component>& components) {
  for (std::size_t i = 0; i < components[0].nodes.size(); ++i)
    if (std::all_of(components.begin(), components.end(), [i](const auto& c) { return c.nodes[i] == 0.0; }))
      place.refuse("all densities are zero in cell " + std::to_string(i));
}

std::vector<WavelengthDistribution::Component> read_components(const Place& place, bool stepped) {
  const std::size_t count = place.array_size();
  if (count < 1 || count > 16) place.refuse("there must be 1 to 16 densities, not " + std::to_string(count));
  std::vector<WavelengthDistribution::Component> components;
  for (std::size_t i = 0; i < count; ++i) {
    components.push_back(read_component(place.at(i), stepped));
    if (components[i].nodes.size() != components[0].nodes.size())
      place.at(i).refuse("all densities must have equally many nodes");
  }
  check_no_gap(place, components);
  return components;
}

WavelengthDistribution::TargetRecord read_targets(const Place& place) {
  place.only_keys({"white", "constructed", "seed", "measured", "measured_file", "measured_digest"});
  return {.white = place.at("white").text(),
          .constructed = static_cast<int>(place.at("constructed").count()),
          .seed = place.at("seed").count(),
          .measured = static_cast<int>(place.at("measured").count()),
          .measured_file = place.at("measured_file").text(),
          .measured_digest = place.at("measured_digest").text()};
}

WavelengthDistribution from_json(const Place& root) {
  // First of all: another version may have other keys.
  if (root.at("format").text() != kFormat)
    root.at("format").refuse(std::string("expected \"") + kFormat + "\"");
  if (root.at("version").number() != kVersion)
    root.at("version").refuse("this program knows version " + std::to_string(kVersion) + " only");
  root.only_keys({"format", "version", "spectrum", "spectrum_digest", "objective", "targets",
                  "optimize_seconds", "value", "baselines", "base", "stepped", "components"});
  const Place baselines = root.at("baselines");
  baselines.only_keys({"uniform", "visible", "illuminant"});
  const bool stepped = root.at("stepped").truth();
  return {.base = read_base(root.at("base")),
          .components = read_components(root.at("components"), stepped),
          .spectrum = root.at("spectrum").text(),
          .spectrum_digest = root.at("spectrum_digest").text(),
          .objective = root.at("objective").text(),
          .targets = read_targets(root.at("targets")),
          .optimize_seconds = root.at("optimize_seconds").number(),
          .value = root.at("value").number(),
          .illuminant_value = baselines.at("illuminant").number(),
          .visible_value = baselines.at("visible").number(),
          .uniform_value = baselines.at("uniform").number(),
          .stepped = stepped};
}

}  // namespace

void write_distribution(const std::filesystem::path& file, const WavelengthDistribution& distribution) {
  write_file(file, to_json(distribution).dump(1, ' ', false, Json::error_handler_t::replace) + '\n');
}

WavelengthDistribution read_distribution(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    throw InputError(file.string(), "cannot be read", "check the path, or make one with 'photopic optimize'");
  Json json;
  try {
    json = Json::parse(in);
  } catch (const Json::parse_error& problem) {
    throw InputError(file.string(), "not valid JSON at byte " + std::to_string(problem.byte),
                     "write the file anew with 'photopic optimize'");
  } catch (const Json::out_of_range&) {
    throw InputError(file.string(), "holds a number too large for a double",
                     "write the file anew with 'photopic optimize'");
  }
  return from_json(Place(file.string(), json));
}

}  // namespace photopic
