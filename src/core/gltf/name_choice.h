#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace photopic {

/// Levenshtein's: insertions, deletions and replacements of bytes. Of long names the beginnings count.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// A message's advice, "choose one of "a", "b"": all of few names, of many those most like what was wanted.
/// @param names at least one
std::string choose_one_of(std::span<const std::string> names, const std::string& wanted);

}  // namespace photopic
