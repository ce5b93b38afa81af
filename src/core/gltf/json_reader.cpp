#include "core/gltf/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/gltf/json_place.h"
#include "error.h"

namespace photopic {
namespace {

constexpr std::size_t kMaxNesting = 100;

/// Builds the document from the parser's events. (nlohmann-json's own way to look at keys, its callback,
/// takes a time quadratic in the length of lists.)
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(const GltfFile& file) : file_(file) {}
  Json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    const auto [place, added] = open_.back()->get_ref<Json::object_t&>().emplace(name, nullptr);
    if (!added)
      fail(fmt::format("the key \"{}\" stands twice in this object", name.substr(0, 60)),
           "take one of them out");
    keys_.back() = &place->first;
    member_ = &place->second;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
    throw InputError(file_.path.string(), "the JSON cannot be parsed: " + parser_message(error.what()),
                     "correct it or export the file again");
  }

 private:
  /// @return where it stands: the root, the last element of a list, or the member whose key was read
  Json& put(Json&& value) {
    Json& place = open_.empty()              ? root_
                  : open_.back()->is_array() ? open_.back()->emplace_back(nullptr)
                                             : *member_;
    return place = std::move(value);
  }
  template <typename Value>
  bool add(Value&& value) {
    put(Json(std::forward<Value>(value)));
    return true;
  }
  bool open(Json&& container) {
    if (open_.size() == kMaxNesting)
      fail(fmt::format("there the JSON is nested more than {} deep", kMaxNesting),
           "take out what is so deep");
    open_.push_back(&put(std::move(container)));
    keys_.push_back(nullptr);
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }

  /// Names the innermost place, or where a very deep one begins.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    constexpr std::size_t kLongest = 8;
    std::string pointer = "#";
    for (std::size_t i = 0; i + 1 < open_.size() && i < kLongest; ++i)
      pointer += keys_[i] ? pointer_token(*keys_[i]) : fmt::format("/{}", open_[i]->size() - 1);
    throw InputError(file_.path.string() + pointer, problem, remedy);
  }

  const GltfFile& file_;
  Json root_;
  std::vector<Json*> open_;  ///< a list grows only while it is the last of these, so that none moves
  std::vector<const std::string*> keys_;  ///< of each the member that was begun last; null for lists
  Json* member_ = nullptr;
};

}  // namespace

std::string parser_message(const std::string& text) {
  const std::size_t tag = text.find("] ");
  std::string message = without_controls(text.substr(tag == std::string::npos ? 0 : tag + 2, 300));
  while (message.ends_with(' ')) message.pop_back();
  // It quotes what may be no text in UTF-8, or cut off amid a letter.
  std::ranges::replace_if(
      message, [](char c) { return static_cast<unsigned char>(c) > 127; }, '?');
  return message;
}

Json parse_gltf_json(const GltfFile& file) {
  Builder builder(file);
  Json::sax_parse(file.json, &builder);
  return builder.take();
}

}  // namespace photopic
