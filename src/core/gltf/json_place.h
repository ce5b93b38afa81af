#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace photopic {

using Json = nlohmann::json;

/// A key as part of a JSON pointer (RFC 6901), "/" before it, fit for one line.
std::string pointer_token(std::string_view key);

/// A value of a glTF document and the way to it, spelled out only when it is wrong. A place points to the one
/// it was made from, which must live as long.
class JsonPlace {
 public:
  JsonPlace(Json& root, const std::filesystem::path& file) : value(root), file_(&file) {}

  Json& value;

  bool has(const char* key) const { return value.is_object() && value.contains(key); }
  JsonPlace member(std::string_view key) const { return {value.at(std::string(key)), this, key, 0}; }
  JsonPlace element(std::size_t index) const { return {value[index], this, {}, index}; }
  /// @param found a member's value, already looked up
  JsonPlace member(std::string_view key, Json& found) const { return {found, this, key, 0}; }

  /// The JSON pointer (RFC 6901), fit for one line.
  std::string pointer() const;

  /// @throws InputError "file#pointer: problem; remedy"
  [[noreturn]] void fail(const std::string& problem,
                         const std::string& remedy = "correct it or export the file again") const;

 private:
  JsonPlace(Json& v, const JsonPlace* parent, std::string_view key, std::size_t index)
      : value(v), file_(parent->file_), parent_(parent), key_(key), index_(index) {}

  const std::filesystem::path* file_;
  const JsonPlace* parent_ = nullptr;
  std::string_view key_;
  std::size_t index_ = 0;
};

/// Calls `visit` at every element of a list; nothing where there is no such member. (Rules have seen to it
/// that it is a list.)
template <typename Visit>
void for_each_in(const JsonPlace& at, const char* list, const Visit& visit) {
  if (!at.has(list)) return;
  const JsonPlace place = at.member(list);
  for (std::size_t i = 0; i < place.value.size(); ++i) visit(place.element(i));
}

/// The member of an extension of this object, or nothing.
template <typename Visit>
void for_extension(const JsonPlace& at, const char* name, const Visit& visit) {
  if (!at.has("extensions")) return;
  const JsonPlace extensions = at.member("extensions");
  if (extensions.has(name)) visit(extensions.member(name));
}

}  // namespace photopic
