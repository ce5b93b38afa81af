#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace photopic {

/// Binds every subcommand's options to the fields of its struct. Parsing the app leaves in `action` what was
/// asked for, in `threads` how many threads it may use (0: all). Spectra, units and defaults stand in the
/// help texts.
void bind_commands(CLI::App& app, std::function<int()>& action, int& threads);

}  // namespace photopic
