#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <variant>

/// The words that the tables of rules (rules.h, material_rules.h) are written in.
namespace photopic::gltf_rules {

struct Member;

struct Boolean {};
struct Text {};
/// One of a few words.
struct OneOf {
  std::span<const std::string_view> words;
};
/// One of OpenGL's numbers.
struct Code {
  std::span<const int> codes;
};
struct Number {
  double min, max;
};
/// A whole number.
struct Whole {
  double min, max;
};
/// A list of `size` numbers.
struct Numbers {
  std::size_t size;
  double min, max;
};
/// An index into a list: its path from the document's root.
struct IndexInto {
  std::string_view list;
};
/// An object: which of its members are known, and what they must be. Others may be there.
struct Object {
  const Member* members = nullptr;
  std::size_t count = 0;

  constexpr Object() = default;
  template <std::size_t N>
  constexpr explicit Object(const Member (&table)[N]) : members(table), count(N) {}
};

using Rule = std::variant<Boolean, Text, OneOf, Code, Number, Whole, Numbers, IndexInto, Object>;

/// How often a member holds what its rule says.
enum class Form : unsigned char { one, list, map, list_of_maps };

struct Member {
  std::string_view name;
  Rule rule;
  Form form = Form::one;
  bool required = false;
};

inline constexpr bool kRequired = true;

/// Limits that keep every later sum of bytes and counts inside 64 bits, and every number a finite float.
inline constexpr double kMaxBytes = 9007199254740991.0, kMaxCount = 2147483647.0, kMaxFloat = 1e38;
/// For numbers that are read as double.
inline constexpr double kNoLimit = 1e300;

}  // namespace photopic::gltf_rules
