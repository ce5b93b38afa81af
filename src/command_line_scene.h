#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "commands.h"

namespace photopic {

/// Samples per pixel, at most.
inline constexpr int kMaxSamples = 1 << 24;
inline CLI::Range samples_range() {
  return {1, kMaxSamples};
}

/// CLI::Range lets "nan" pass.
CLI::Validator number_between(double min, double max);

/// What a scene is loaded with.
void bind_scene_file(CLI::App& command, SceneArguments& a);

/// That, and what it is rendered with. @param served what the --distribution serves
void bind_scene(CLI::App& command, SceneArguments& a, const std::string& served);

}  // namespace photopic
