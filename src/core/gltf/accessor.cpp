#include "core/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace photopic {
namespace {

template <typename T>
T read_as(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <typename T>
float read_integer(const std::byte* bytes, bool normalized) {
  const auto value = static_cast<float>(read_as<T>(bytes));
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : value;
}

float read_component(const std::byte* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return read_integer<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return read_integer<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return read_integer<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return read_integer<std::uint16_t>(bytes, normalized);
    default:
      return read_as<float>(bytes);
  }
}

std::uint32_t read_index(const std::byte* bytes, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return read_as<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return read_as<std::uint16_t>(bytes);
    default:
      return read_as<std::uint32_t>(bytes);
  }
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Of a buffer that has no uri, as a fallback for compressed data may.
[[noreturn]] void refuse_without_bytes(const GltfDocument& document, int view) {
  const tinygltf::BufferView& source = document.model.bufferViews[view];
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (source.extensions.contains(name))
      document.fail(
          fmt::format("/bufferViews/{}", view),
          fmt::format("it is compressed by {}, which cannot be read, and the file holds it in no other "
                      "way",
                      name),
          "export it without compression");
  document.fail(fmt::format("/buffers/{}", source.buffer), "it has no uri, so there are no bytes to read",
                "export the file again with its buffers");
}

/// The bytes from a view's offset on; nothing for the view that stands for none.
const std::byte* view_bytes(const GltfDocument& document, int view, std::size_t offset) {
  const auto& views = document.model.bufferViews;
  if (static_cast<std::size_t>(view) + 1 == views.size()) return nullptr;
  const auto& bytes = document.buffers[static_cast<std::size_t>(views[view].buffer)];
  if (bytes.empty()) refuse_without_bytes(document, view);
  return bytes.data() + views[view].byteOffset + offset;
}

/// Calls `store(i, bytes)` for every element that the file gives bytes for, substitutions last.
template <typename Store>
void for_each_element(const GltfDocument& document, int index, const Store& store) {
  const tinygltf::Accessor& accessor = document.model.accessors[index];
  const auto component_size =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(accessor.componentType));
  const std::size_t size =
      component_size * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(accessor.type));
  if (const std::byte* bytes = view_bytes(document, accessor.bufferView, accessor.byteOffset)) {
    const std::size_t own_stride = document.model.bufferViews[accessor.bufferView].byteStride;
    const std::size_t stride = own_stride > 0 ? own_stride : size;
    for (std::size_t i = 0; i < accessor.count; ++i) store(i, bytes + i * stride);
  }
  if (!accessor.sparse.isSparse) return;

  const auto& sparse = accessor.sparse;
  const std::string pointer = fmt::format("/accessors/{}/sparse/indices", index);
  if (!is_index_type(sparse.indices.componentType))
    document.fail(pointer, "its component type is not an unsigned integer");
  const auto index_size =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(sparse.indices.componentType));
  const std::byte* indices = view_bytes(document, sparse.indices.bufferView, sparse.indices.byteOffset);
  const std::byte* values = view_bytes(document, sparse.values.bufferView, sparse.values.byteOffset);
  for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
    const std::uint32_t element = read_index(indices + i * index_size, sparse.indices.componentType);
    if (element >= accessor.count)
      document.fail(pointer, fmt::format("index {} lies beyond the {} elements", element, accessor.count));
    store(element, values + i * size);
  }
}

template <typename T>
struct ElementType;
template <>
struct ElementType<Vec2f> {
  static constexpr int kType = TINYGLTF_TYPE_VEC2;
  static constexpr const char* kName = "VEC2";
};
template <>
struct ElementType<Vec3f> {
  static constexpr int kType = TINYGLTF_TYPE_VEC3;
  static constexpr const char* kName = "VEC3";
};
template <>
struct ElementType<Vec4f> {
  static constexpr int kType = TINYGLTF_TYPE_VEC4;
  static constexpr const char* kName = "VEC4";
};
template <>
struct ElementType<Mat4f> {
  static constexpr int kType = TINYGLTF_TYPE_MAT4;
  static constexpr const char* kName = "MAT4";
};

}  // namespace

template <typename T>
std::vector<T> read_elements(const GltfDocument& document, int index) {
  using Type = ElementType<T>;
  constexpr std::size_t kCount = sizeof(T) / sizeof(float);
  const tinygltf::Accessor& accessor = document.model.accessors[index];
  const std::string pointer = fmt::format("/accessors/{}", index);
  const int type = accessor.componentType;
  if (accessor.type != Type::kType || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    document.fail(pointer, fmt::format("this must be {} of floats, bytes or shorts", Type::kName));
  const auto size = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(type));
  std::vector<T> elements(accessor.count);
  for_each_element(document, index, [&](std::size_t i, const std::byte* bytes) {
    std::array<float, kCount> components;
    bool finite = true;
    for (std::size_t c = 0; c < kCount; ++c) {
      components[c] = read_component(bytes + c * size, type, accessor.normalized);
      finite = finite && std::isfinite(components[c]);
    }
    if (!finite) document.fail(pointer, fmt::format("element {} is not finite", i));
    elements[i] = std::bit_cast<T>(components);
  });
  return elements;
}
template std::vector<Vec2f> read_elements<Vec2f>(const GltfDocument&, int);
template std::vector<Vec3f> read_elements<Vec3f>(const GltfDocument&, int);
template std::vector<Vec4f> read_elements<Vec4f>(const GltfDocument&, int);
template std::vector<Mat4f> read_elements<Mat4f>(const GltfDocument&, int);

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model.accessors[index];
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_index_type(accessor.componentType)) {
    document.fail(fmt::format("/accessors/{}", index), "indices must be SCALAR unsigned integers");
  }
  std::vector<std::uint32_t> elements(accessor.count);
  for_each_element(document, index, [&](std::size_t i, const std::byte* bytes) {
    elements[i] = read_index(bytes, accessor.componentType);
  });
  return elements;
}

}  // namespace photopic
