#include "core/gltf/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/gltf/json_place.h"
#include "core/gltf/member_checks.h"
#include "core/gltf/rules.h"
#include "error.h"

namespace photopic {
namespace {

using namespace gltf_rules;

/// How many elements the list has that indices point into.
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

/// Whole numbers may be written with a zero fraction or an exponent (glTF 2.0, section 2.7).
void check_whole(const JsonPlace& at) {
  if (at.value.is_number_float()) {
    const double number = at.value.get<double>();
    if (number == std::floor(number) && std::abs(number) <= kMaxBytes)
      at.value = static_cast<std::int64_t>(number);
  }
  if (!at.value.is_number_integer()) at.fail("this must be a whole number");
}

void check_range(const JsonPlace& at, double min, double max) {
  const double number = at.value.get<double>();
  if (!(number >= min && number <= max))
    at.fail(fmt::format("{} is not between {} and {}", number, min, max));
}

/// Applies a rule to a value and what is in it. Recursion is as deep as the tables.
class RuleCheck {
 public:
  RuleCheck(const JsonPlace& at, const Json& document) : at_(at), document_(document) {}

  void operator()(const Boolean&) const {
    if (!at_.value.is_boolean()) at_.fail("this must be true or false");
  }
  void operator()(const Text&) const {
    if (!at_.value.is_string()) at_.fail("this must be a string");
  }
  void operator()(const OneOf& rule) const {
    (*this)(Text{});
    if (std::ranges::count(rule.words, at_.value.get_ref<const std::string&>()) == 0)
      at_.fail(fmt::format("this is none of {}", fmt::join(rule.words, ", ")));
  }
  void operator()(const Code& rule) const {
    check_whole(at_);
    const auto is_this = [&](int code) { return at_.value == code; };
    if (std::ranges::none_of(rule.codes, is_this))
      at_.fail(fmt::format("this is none of {}", fmt::join(rule.codes, ", ")));
  }
  void operator()(const Number& rule) const {
    if (!at_.value.is_number()) at_.fail("this must be a number");
    check_range(at_, rule.min, rule.max);
  }
  void operator()(const Whole& rule) const {
    check_whole(at_);
    check_range(at_, rule.min, rule.max);
  }
  void operator()(const Numbers& rule) const {
    if (!at_.value.is_array() || at_.value.size() != rule.size)
      at_.fail(fmt::format("this must be a list of {} numbers", rule.size));
    for (std::size_t i = 0; i < rule.size; ++i) apply(at_.element(i), Number{rule.min, rule.max});
  }
  void operator()(const IndexInto& rule) const {
    check_whole(at_);
    const std::size_t size = list_size(document_, rule.list);
    const bool inside = at_.value >= 0 && at_.value.get<std::uint64_t>() < size;
    if (!inside)
      at_.fail(fmt::format("{} points outside \"{}\", which holds {}", at_.value.dump(), rule.list, size));
  }
  void operator()(const Object& rule) const {
    if (!at_.value.is_object()) at_.fail("this must be an object");
    if (at_.has("name")) apply(at_.member("name"), Text{});
    if (at_.has("extensions")) apply(at_.member("extensions"), Object{});
    for (std::size_t i = 0; i < rule.count; ++i) apply_member(rule.members[i]);
  }

 private:
  void apply(const JsonPlace& at, const Rule& rule) const { std::visit(RuleCheck(at, document_), rule); }

  void apply_member(const Member& member) const {
    const auto found = at_.value.find(std::string(member.name));
    if (found != at_.value.end())
      apply_form(at_.member(member.name, *found), member, member.form);
    else if (member.required)
      at_.fail(fmt::format("\"{}\" is missing", member.name));
  }

  void apply_form(const JsonPlace& at, const Member& member, Form form) const {
    if (form == Form::one) return apply(at, member.rule);
    if (form == Form::map) {
      if (!at.value.is_object()) at.fail("this must be an object");
      for (auto& [key, value] : at.value.items()) apply(at.member(key, value), member.rule);
      return;
    }
    if (!at.value.is_array()) at.fail("this must be a list");
    const Form inner = form == Form::list ? Form::one : Form::map;
    for (std::size_t i = 0; i < at.value.size(); ++i) apply_form(at.element(i), member, inner);
  }

  const JsonPlace& at_;
  const Json& document_;
};

void check_version(const JsonPlace& root) {
  if (!root.value.is_object()) root.fail("a glTF file is a JSON object");
  if (!root.has("asset")) root.fail("\"asset\" is missing");
  const JsonPlace asset = root.member("asset");
  for (const char* key : {"version", "minVersion"}) {
    if (!asset.has(key)) continue;
    const JsonPlace version = asset.member(key);
    if (!version.value.is_string()) version.fail("this must be a string");
    const auto text = version.value.get<std::string>();
    const bool good = std::string_view(key) == "version" ? text.starts_with("2.") : text == "2.0";
    if (!good) version.fail("only glTF 2.0 can be read", "export glTF 2.0");
  }
  if (!asset.has("version")) asset.fail("\"version\" is missing");
}

void check_extensions(const JsonPlace& root) {
  for_each_in(root, "extensionsRequired", [](const JsonPlace& at) {
    const auto name = at.value.get<std::string>();
    if (std::ranges::count(kSupported, name) == 0)
      at.fail(fmt::format("the file requires {}, which cannot be read", name.substr(0, 60)),
              "export it without that extension");
  });
}

}  // namespace

std::string pointer_token(std::string_view key) {
  std::string escaped = "/";
  for (const char c : key.substr(0, 60)) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  }
  return escaped;
}

std::string JsonPlace::pointer() const {
  if (!parent_) return {};
  return parent_->pointer() + (parent_->value.is_array() ? fmt::format("/{}", index_) : pointer_token(key_));
}

void JsonPlace::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(file_->string() + "#" + pointer(), problem, remedy);
}

void check_gltf(Json& document, const std::filesystem::path& file) {
  const JsonPlace root(document, file);
  check_version(root);
  RuleCheck(root, document)(Object(kDocument));
  check_extensions(root);
  check_objects(root);
  check_bytes(root);
  check_meshes(root);
}

}  // namespace photopic
