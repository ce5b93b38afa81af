#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace photopic {

/// Prints help or version where that is what was asked for, else one line on what is wrong with the command
/// line.
/// @param words all that were given, the program's name left out
/// @return the exit code
int explain(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words);

}  // namespace photopic
