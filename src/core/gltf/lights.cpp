#include "core/gltf/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "error.h"

namespace photopic {
namespace {

/// The light that hangs at a node, or −1.
int light_of(const tinygltf::Node& node) {
  const auto extension = node.extensions.find(kPunctualLights);
  if (extension == node.extensions.end() || !extension->second.Has("light")) return -1;
  return extension->second.Get("light").GetNumberAsInt();
}

Rgb color_of(const tinygltf::Light& light) {
  if (light.color.size() != 3) return {1, 1, 1};
  return {light.color[0], light.color[1], light.color[2]};
}

/// @param light whose type is known
PunctualLight::Kind kind_of(const tinygltf::Light& light) {
  if (light.type == "point") return PunctualLight::Kind::point;
  return light.type == "spot" ? PunctualLight::Kind::spot : PunctualLight::Kind::directional;
}

/// Lights shine along their node's −z, whatever its scale.
Vec3f direction_of(const GltfDocument& document, const NodeInstance& instance) {
  const Vec3d direction = -instance.to_world.z;
  const double size = max_abs(direction);
  if (!(size > 0.0))
    document.fail(fmt::format("/nodes/{}", instance.node), "its scale leaves the light no direction",
                  "set the scale to 1");
  return to_float(normalize(direction / size));
}

PunctualLight place(const GltfDocument& document, const NodeInstance& instance, PunctualLight light,
                    const tinygltf::Light& source, Vec3d origin) {
  light.name = source.name.empty() ? document.model.nodes[instance.node].name : source.name;
  light.position = to_float(instance.to_world.t - origin);
  if (light.kind != PunctualLight::Kind::point) light.direction = direction_of(document, instance);
  if (light.kind == PunctualLight::Kind::spot) {
    const double outer = source.spot.outerConeAngle, inner = std::min(source.spot.innerConeAngle, outer);
    light.cos_inner = static_cast<float>(std::cos(inner));
    light.cos_outer = static_cast<float>(std::cos(outer));
  }
  return light;
}

}  // namespace

void load_gltf_lights(const GltfDocument& document, const std::vector<NodeInstance>& instances,
                      const GltfOptions& options, GltfEmissions& emissions, Scene& scene) {
  std::size_t ranged = 0;
  for (const NodeInstance& instance : instances) {
    const int index = light_of(document.model.nodes[instance.node]);
    if (index < 0 || !instance.visible) continue;
    const tinygltf::Light& source = document.model.lights[index];
    const std::string pointer = fmt::format("/extensions/KHR_lights_punctual/lights/{}", index);
    const double luminance = linear_srgb_to_xyz(color_of(source)).y * source.intensity;
    const auto intensity = static_cast<float>(luminance * options.punctual_scale);
    if (!(intensity > 0.0f)) {
      if (!(luminance > 0.0))
        emissions.check_dark(source.extras, pointer, "give it an intensity and a color above 0");
      continue;
    }
    if (!std::isfinite(intensity)) document.fail(pointer + "/intensity", "this is too bright for a number");
    if (source.range > 0.0) ++ranged;
    const int spectrum =
        emissions.add({source.name, "light", pointer, "color", color_of(source), &source.extras}).spectrum;
    scene.punctual_lights.push_back(place(
        document, instance,
        {.kind = kind_of(source), .intensity = intensity, .emission_spectrum = spectrum, .index = index},
        source, scene.origin));
  }
  if (options.punctual_scale != 1.0 && scene.punctual_lights.empty())
    scene.warnings.emplace_back("--punctual-scale has no effect: the scene has no punctual lights");
  if (ranged > 0)
    scene.warnings.push_back(fmt::format("lights with a range, rendered as if without: {}", ranged));
}

namespace {

/// Equirectangular maps are twice as wide as high; where a picture is one pixel wide or high, nothing is
/// seen of how far it is stretched.
void check_environment_shape(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  const ImageShape shape = read_image_shape(file);
  if (!shape.is_whole())
    throw InputError(
        file.string(),
        fmt::format("its pixels, {}x{}, are not all of the picture, {}x{} (EXR's data and display "
                    "window), and would be stretched over the whole sky",
                    shape.width, shape.height, shape.full_width, shape.full_height),
        "write it whole");
  if (std::min(shape.width, shape.height) > 1 && std::abs(shape.width - 2 * shape.height) > 1)
    warnings.push_back(
        fmt::format("{}: is {}x{} pixels where an equirectangular map is twice as wide as high: "
                    "it is stretched over the sky",
                    file.string(), shape.width, shape.height));
}

}  // namespace

void load_gltf_environment(const GltfDocument& document, const GltfOptions& options, GltfEmissions& emissions,
                           Scene& scene) {
  const bool given = !options.environment.file.empty();
  if (!given && emissions.has_lamp()) return;
  if (given) check_environment_shape(options.environment.file, scene.warnings);
  Environment environment = given ? load_environment(options.environment, scene.warnings) : overcast_sky();
  environment.emission_spectrum =
      emissions.add({"environment", "environment", "", "", {1, 1, 1}, nullptr}).spectrum;
  scene.environment = std::make_shared<const Environment>(std::move(environment));
  if (!given)
    scene.warnings.push_back(
        fmt::format("nothing in {} emits light: lit by an overcast sky", document.file.path.string()));
}

}  // namespace photopic
