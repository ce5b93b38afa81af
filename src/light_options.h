#pragma once

#include "commands.h"

namespace CLI {
class App;
}

namespace photopic {

/// Binds the options that say what light there is: lamps' spectra, punctual lights, the environment.
void bind_lights(CLI::App& command, SceneArguments& arguments);

}  // namespace photopic
