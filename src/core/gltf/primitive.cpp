#include "core/gltf/primitive.h"

#include <fmt/format.h>

#include <algorithm>

namespace photopic {
namespace {

bool is_list(const tinygltf::Primitive& primitive) {
  return primitive.mode == -1 || primitive.mode == TINYGLTF_MODE_TRIANGLES;
}

std::size_t corner_count(const GltfDocument& document, const tinygltf::Primitive& primitive) {
  return primitive.indices >= 0 ? document.model.accessors[primitive.indices].count
                                : vertex_count(document, primitive);
}

const std::vector<double>& morph_weights(const GltfDocument& document, const PrimitiveRef& ref, int node) {
  const auto& model = document.model;
  const bool own = node >= 0 && !model.nodes[node].weights.empty();
  return own ? model.nodes[node].weights : model.meshes[ref.mesh].weights;
}

void displace(Vec3f& value, Vec3f by, float weight) {
  value = value + by * weight;
}
void displace(Vec4f& value, Vec3f by, float weight) {
  value = {value.x + by.x * weight, value.y + by.y * weight, value.z + by.z * weight, value.w};
}

}  // namespace

std::string PrimitiveRef::pointer() const {
  return fmt::format("/meshes/{}/primitives/{}", mesh, index);
}

bool draws_triangles(const tinygltf::Primitive& primitive) {
  return primitive.mode == -1 ||
         (primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN);
}

std::size_t vertex_count(const GltfDocument& document, const tinygltf::Primitive& primitive) {
  return document.model.accessors[primitive.attributes.at("POSITION")].count;
}

std::size_t stored_vertex_count(const GltfDocument& document, const tinygltf::Primitive& primitive) {
  return std::min(vertex_count(document, primitive), corner_count(document, primitive));
}

std::size_t triangle_count(const GltfDocument& document, const tinygltf::Primitive& primitive) {
  const std::size_t corners = corner_count(document, primitive);
  return is_list(primitive) ? corners / 3 : corners >= 3 ? corners - 2 : 0;
}

bool has_left_over(const GltfDocument& document, const tinygltf::Primitive& primitive) {
  const std::size_t corners = corner_count(document, primitive);
  return is_list(primitive) ? corners % 3 != 0 : corners < 3;
}

Triangle corners_of(const tinygltf::Primitive& primitive, std::uint32_t i) {
  if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) return {i, i + 1 + i % 2, i + 2 - i % 2};
  if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) return {i + 1, i + 2, 0};
  return {3 * i, 3 * i + 1, 3 * i + 2};
}

std::vector<std::uint32_t> read_checked_indices(const GltfDocument& document, const PrimitiveRef& ref) {
  const tinygltf::Primitive& primitive = ref.in(document);
  if (primitive.indices < 0) return {};
  const std::size_t vertices = vertex_count(document, primitive);
  std::vector<std::uint32_t> indices = read_indices(document, primitive.indices);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= vertices)
      document.fail(ref.pointer() + "/indices",
                    fmt::format("index {} at {} lies beyond the {} vertices", indices[i], i, vertices));
  }
  return indices;
}

template <typename T>
std::vector<T> read_attribute(const GltfDocument& document, const PrimitiveRef& ref, const char* name) {
  const auto& attributes = ref.in(document).attributes;
  const auto found = attributes.find(name);
  if (found == attributes.end()) return {};
  return read_elements<T>(document, found->second);
}
template std::vector<Vec2f> read_attribute<Vec2f>(const GltfDocument&, const PrimitiveRef&, const char*);
template std::vector<Vec4f> read_attribute<Vec4f>(const GltfDocument&, const PrimitiveRef&, const char*);

std::vector<Vec4f> read_colors(const GltfDocument& document, const PrimitiveRef& ref, bool& limited) {
  const auto& attributes = ref.in(document).attributes;
  const auto found = attributes.find("COLOR_0");
  if (found == attributes.end()) return {};
  const tinygltf::Accessor& accessor = document.model.accessors[found->second];
  if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !accessor.normalized)
    document.fail(fmt::format("/accessors/{}/normalized", found->second),
                  "colours of integers must be normalised", "set \"normalized\" to true");
  std::vector<Vec4f> colors;
  if (accessor.type == TINYGLTF_TYPE_VEC3) {
    for (const Vec3f& c : read_attribute<Vec3f>(document, ref, "COLOR_0"))
      colors.push_back({c.x, c.y, c.z, 1});
  } else {
    colors = read_attribute<Vec4f>(document, ref, "COLOR_0");
  }
  for (Vec4f& c : colors)
    for (float* component : {&c.x, &c.y, &c.z, &c.w}) {
      const float inside = std::clamp(*component, 0.0f, 1.0f);
      limited |= inside != *component;
      *component = inside;
    }
  return colors;
}

template <typename T>
std::vector<T> read_morphed(const GltfDocument& document, const PrimitiveRef& ref, int node,
                            const char* name) {
  std::vector<T> values = read_attribute<T>(document, ref, name);
  if (values.empty()) return values;
  const auto& targets = ref.in(document).targets;
  const auto& weights = morph_weights(document, ref, node);
  for (std::size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
    const auto found = targets[t].find(name);
    if (weights[t] == 0 || found == targets[t].end()) continue;
    const std::vector<Vec3f> by = read_elements<Vec3f>(document, found->second);
    for (std::size_t i = 0; i < values.size(); ++i)
      displace(values[i], by[i], static_cast<float>(weights[t]));
  }
  return values;
}
template std::vector<Vec3f> read_morphed<Vec3f>(const GltfDocument&, const PrimitiveRef&, int, const char*);
template std::vector<Vec4f> read_morphed<Vec4f>(const GltfDocument&, const PrimitiveRef&, int, const char*);

bool is_morphed(const GltfDocument& document, const PrimitiveRef& ref, int node) {
  const auto& weights = morph_weights(document, ref, node);
  return !ref.in(document).targets.empty() &&
         std::ranges::any_of(weights, [](double weight) { return weight != 0; });
}

}  // namespace photopic
