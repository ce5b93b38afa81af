#pragma once

#include <span>
#include <string>

namespace photopic {

/// A message's advice, "choose one of "a", "b"": all of few names, of many those most like what was wanted.
/// @param names at least one
std::string choose_one_of(std::span<const std::string> names, const std::string& wanted);

}  // namespace photopic
