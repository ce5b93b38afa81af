#pragma once

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace photopic {

/// Prints help or version where that is what was asked for, else one line on what is wrong with the command
/// line.
/// @return the exit code
int explain(const CLI::App& app, const CLI::ParseError& error);

}  // namespace photopic
