#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>

#include "core/gltf/member_checks.h"

namespace photopic {
namespace {

std::uint64_t integer(const Json& object, const char* key, std::uint64_t otherwise = 0) {
  return object.contains(key) ? object.at(key).get<std::uint64_t>() : otherwise;
}

std::uint64_t component_size(const JsonPlace& at) {
  switch (at.value.get<int>()) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      at.fail(fmt::format("{} is no component type", at.value.get<int>()));
  }
}

std::uint64_t component_count(const JsonPlace& at) {
  const auto& type = at.value.get_ref<const std::string&>();
  for (const auto& [name, count] : {std::pair{"SCALAR", 1},
                                    {"VEC2", 2},
                                    {"VEC3", 3},
                                    {"VEC4", 4},
                                    {"MAT2", 4},
                                    {"MAT3", 9},
                                    {"MAT4", 16}}) {
    if (type == name) return static_cast<std::uint64_t>(count);
  }
  at.fail("this is no accessor type");
}

/// Columns of matrices begin at multiples of 4 bytes (glTF 2.0, section 3.6.2.4).
std::uint64_t element_size(const JsonPlace& accessor) {
  const std::uint64_t component = component_size(accessor.member("componentType"));
  const std::uint64_t count = component_count(accessor.member("type"));
  const auto& type = accessor.value.at("type").get_ref<const std::string&>();
  if (!type.starts_with("MAT")) return component * count;
  const auto columns = static_cast<std::uint64_t>(type.back() - '0');
  return columns * ((component * columns + 3) / 4 * 4);
}

/// All sums stay far below 2^64: bytes are below 2^53, counts below 2^31, strides below 2^8.
void check_span(const JsonPlace& at, const Json& views, std::uint64_t count, std::uint64_t size,
                bool strided) {
  const Json& view = views.at(at.value.at("bufferView").get<std::size_t>());
  const std::uint64_t stride = strided ? integer(view, "byteStride", size) : size;
  if (stride < size)
    at.fail(fmt::format("its elements of {} bytes overlap at a byteStride of {}", size, stride));
  const std::uint64_t end = integer(at.value, "byteOffset") + (count - 1) * stride + size;
  const std::uint64_t length = integer(view, "byteLength");
  if (end > length)
    at.fail(fmt::format("it needs {} bytes of bufferView {}, which holds {}", end,
                        at.value.at("bufferView").get<int>(), length));
}

void check_accessor(const JsonPlace& at, const Json& views) {
  constexpr std::uint64_t kMaxZeros = 1 << 20;  // elements that no bytes of the file stand behind
  const std::uint64_t size = element_size(at);
  const std::uint64_t count = integer(at.value, "count");
  if (at.has("bufferView")) {
    check_span(at, views, count, size, true);
  } else if (count > kMaxZeros) {
    at.member("count").fail(fmt::format("{} elements without a bufferView are too many", count));
  }
  if (!at.has("sparse")) return;

  const JsonPlace sparse = at.member("sparse");
  const std::uint64_t sparse_count = integer(sparse.value, "count");
  if (sparse_count > count) sparse.fail(fmt::format("it replaces {} elements of {}", sparse_count, count));
  const JsonPlace indices = sparse.member("indices");
  check_span(indices, views, sparse_count, component_size(indices.member("componentType")), false);
  check_span(sparse.member("values"), views, sparse_count, size, false);
}

}  // namespace

void check_bytes(const JsonPlace& root) {
  for_each_in(root, "bufferViews", [&](const JsonPlace& at) {
    const std::uint64_t end = integer(at.value, "byteOffset") + integer(at.value, "byteLength");
    const std::uint64_t length =
        integer(root.value.at("buffers").at(at.value.at("buffer").get<std::size_t>()), "byteLength");
    if (end > length) at.fail(fmt::format("it ends at byte {} of a buffer of {}", end, length));
  });
  static const Json kNoViews = Json::array();
  const Json& views = root.has("bufferViews") ? root.value.at("bufferViews") : kNoViews;
  for_each_in(root, "accessors", [&](const JsonPlace& at) { check_accessor(at, views); });
}

}  // namespace photopic
