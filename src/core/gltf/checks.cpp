#include "core/gltf/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "core/gltf/rules.h"
#include "error.h"

namespace photopic {
namespace {

using Json = nlohmann::json;
constexpr const char* kReexport = "correct it or export the file again";

/// A JSON pointer's token (RFC 6901), fit for one line.
std::string token(std::string_view key) {
  std::string escaped = "/";
  for (const char c : key.substr(0, 60)) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += static_cast<unsigned char>(c) < 32 ? '?' : c;
  }
  return escaped;
}

/// A value and the way to it.
struct Place {
  const Json& value;
  std::string pointer;
  const std::filesystem::path& file;

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = kReexport) const {
    throw InputError(file.string() + "#" + pointer, problem, remedy);
  }
  Place member(std::string_view key) const {
    return {value.at(std::string(key)), pointer + token(key), file};
  }
};

/// Calls `visit` at every value that the path leads to.
template <typename Visit>
void for_each(const Place& at, std::string_view path, const Visit& visit) {
  if (path.empty()) return visit(at);
  const std::size_t slash = path.find('/');
  const std::string_view head = path.substr(0, slash);
  const std::string_view rest = slash == path.npos ? std::string_view() : path.substr(slash + 1);
  if (head == "*" && at.value.is_array()) {
    for (std::size_t i = 0; i < at.value.size(); ++i)
      for_each(Place{at.value[i], at.pointer + fmt::format("/{}", i), at.file}, rest, visit);
  } else if (head == "*" && at.value.is_object()) {
    for (const auto& [key, child] : at.value.items())
      for_each(Place{child, at.pointer + token(key), at.file}, rest, visit);
  } else if (head == "*") {
    at.fail("this must be a list");
  } else if (!at.value.is_object()) {
    at.fail("this must be an object");
  } else if (at.value.contains(head)) {
    for_each(at.member(head), rest, visit);
  }
}

std::size_t list_size(const Json& document, std::string_view path) {
  const Json* list = &document;
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    const auto found = list->is_object() ? list->find(std::string(path.substr(0, slash))) : list->end();
    if (!list->is_object() || found == list->end()) return 0;
    list = &*found;
    path = slash == path.npos ? std::string_view() : path.substr(slash + 1);
  }
  return list->is_array() ? list->size() : 0;
}

void check_number(const Place& at, double min, double max, bool integer) {
  if (integer ? !at.value.is_number_integer() : !at.value.is_number())
    at.fail(integer ? "this must be a whole number" : "this must be a number");
  const double number = at.value.get<double>();
  if (!(number >= min && number <= max))
    at.fail(fmt::format("{} is not between {} and {}", number, min, max));
}

/// A camera's type names the member that describes it.
void check_cameras(const Place& root) {
  for_each(root, "cameras/*", [](const Place& at) {
    const auto type = at.value.at("type").get<std::string>();
    if (type != "perspective" && type != "orthographic") {
      at.member("type").fail("this is neither perspective nor orthographic");
    }
    if (!at.value.contains(type)) at.fail(fmt::format("\"{}\" is missing", type));
  });
}

void check_version(const Place& root) {
  if (!root.value.is_object()) root.fail("a glTF file is a JSON object");
  if (!root.value.contains("asset")) root.fail("\"asset\" is missing");
  const Place asset = root.member("asset");
  for (const char* key : {"version", "minVersion"}) {
    if (!asset.value.is_object() || !asset.value.contains(key)) continue;
    const Place version = asset.member(key);
    if (!version.value.is_string()) version.fail("this must be a string");
    const auto text = version.value.get<std::string>();
    const bool good = std::string_view(key) == "version" ? text.starts_with("2.") : text == "2.0";
    if (!good) version.fail("only glTF 2.0 can be read", "export glTF 2.0");
  }
  if (!asset.value.is_object() || !asset.value.contains("version")) asset.fail("\"version\" is missing");
}

void check_extensions(const Place& root) {
  using namespace gltf_rules;
  for_each(root, "extensionsRequired/*", [](const Place& at) {
    const auto name = at.value.get<std::string>();
    const bool known = std::ranges::count(kSupported, name) + std::ranges::count(kReported, name) > 0;
    if (!known)
      at.fail(fmt::format("the file requires {}, which cannot be read", name.substr(0, 60)),
              "export it without that extension");
  });
}

void check_rules(const Place& root) {
  using namespace gltf_rules;
  for (const auto path : kLists) {
    for_each(root, path, [](const Place& at) {
      if (!at.value.is_array()) at.fail("this must be a list");
    });
  }
  for (const auto path : kObjects)
    for_each(root, path, [](const Place& at) {
      if (!at.value.is_object()) at.fail("this must be an object");
    });
  for (const auto path : kStrings)
    for_each(root, path, [](const Place& at) {
      if (!at.value.is_string()) at.fail("this must be a string");
    });
  for (const auto path : kBooleans)
    for_each(root, path, [](const Place& at) {
      if (!at.value.is_boolean()) at.fail("this must be true or false");
    });
  for (const auto& [path, member] : kRequired) {
    for_each(root, path, [&](const Place& at) {
      if (!at.value.contains(member)) at.fail(fmt::format("\"{}\" is missing", member));
    });
  }
  for (const auto& rule : kIntegers)
    for_each(root, rule.path, [&](const Place& at) { check_number(at, rule.min, rule.max, true); });
  for (const auto& rule : kNumbers)
    for_each(root, rule.path, [&](const Place& at) { check_number(at, rule.min, rule.max, false); });
  for (const auto& rule : kVectors) {
    for_each(root, rule.path, [&](const Place& at) {
      if (!at.value.is_array() || at.value.size() != rule.size)
        at.fail(fmt::format("this must be a list of {} numbers", rule.size));
      for_each(at, "*", [&](const Place& element) { check_number(element, rule.min, rule.max, false); });
    });
  }
  for (const auto& rule : kReferences) {
    const std::size_t size = list_size(root.value, rule.target);
    for_each(root, rule.path, [&](const Place& at) {
      if (!at.value.is_number_integer()) at.fail("this must be a whole number");
      const bool inside = at.value.is_number_unsigned() && at.value.get<std::uint64_t>() < size;
      if (!inside)
        at.fail(fmt::format("{} points outside \"{}\", which holds {}", at.value.dump(), rule.target, size));
    });
  }
}

std::uint64_t integer(const Json& object, const char* key, std::uint64_t otherwise = 0) {
  return object.contains(key) ? object.at(key).get<std::uint64_t>() : otherwise;
}

std::uint64_t component_size(const Place& at) {
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

std::uint64_t component_count(const Place& at) {
  const auto type = at.value.get<std::string>();
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

/// All sums stay far below 2^64: bytes are below 2^53, counts below 2^31, strides below 2^8.
void check_span(const Place& at, const Json& views, std::uint64_t count, std::uint64_t size, bool strided) {
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

void check_accessor(const Place& at, const Json& views) {
  constexpr std::uint64_t kMaxZeros = 1 << 24;  // elements that no bytes of the file stand behind
  const std::uint64_t size = component_size(at.member("componentType")) * component_count(at.member("type"));
  const std::uint64_t count = integer(at.value, "count");
  if (at.value.contains("bufferView")) {
    check_span(at, views, count, size, true);
  } else if (count > kMaxZeros) {
    at.member("count").fail(fmt::format("{} elements without a bufferView are too many", count));
  }
  if (!at.value.contains("sparse")) return;

  const Place sparse = at.member("sparse");
  const std::uint64_t sparse_count = integer(sparse.value, "count");
  if (sparse_count > count) sparse.fail(fmt::format("it replaces {} elements of {}", sparse_count, count));
  const Place indices = sparse.member("indices");
  check_span(indices, views, sparse_count, component_size(indices.member("componentType")), false);
  check_span(sparse.member("values"), views, sparse_count, size, false);
}

void check_bytes(const Place& root) {
  for_each(root, "bufferViews/*", [&](const Place& at) {
    const std::uint64_t end = integer(at.value, "byteOffset") + integer(at.value, "byteLength");
    const std::uint64_t length =
        integer(root.value.at("buffers").at(at.value.at("buffer").get<std::size_t>()), "byteLength");
    if (end > length) at.fail(fmt::format("it ends at byte {} of a buffer of {}", end, length));
  });
  static const Json kNoViews = Json::array();
  const Json& views = root.value.contains("bufferViews") ? root.value.at("bufferViews") : kNoViews;
  for_each(root, "accessors/*", [&](const Place& at) { check_accessor(at, views); });
}

}  // namespace

void check_gltf(const Json& document, const std::filesystem::path& file) {
  const Place root{document, "", file};
  check_version(root);
  check_rules(root);
  check_cameras(root);
  check_extensions(root);
  check_bytes(root);
}

}  // namespace photopic
