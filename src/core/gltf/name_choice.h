#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace photopic {

/// Levenshtein's: insertions, deletions and replacements of bytes. Of long names the beginnings count.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// @return N of "N" or "index:N", or −1
int parse_index(std::string_view text);

/// Where the chosen of a kind shares its name with another. @param kind the option's name, "camera"
std::string namesake_warning(std::string_view kind, const std::string& name, int other);

/// A message's advice, "choose one of "a", "b"": all of few names, of many those most like what was wanted.
/// @param names at least one
std::string choose_one_of(std::span<const std::string> names, const std::string& wanted);

}  // namespace photopic
