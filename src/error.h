#pragma once

#include <stdexcept>
#include <string>

namespace photopic {

/// Something the user gave is wrong and the user can mend it. Printed as one line; the exit code is 1.
class InputError : public std::runtime_error {
 public:
  /// @param where   the user's file and the place in it ("lamp.csv:12", "scene.gltf#/meshes/3"), or the
  /// option
  /// @param problem what is wrong there
  /// @param remedy  what to do about it
  InputError(const std::string& where, const std::string& problem, const std::string& remedy)
      : std::runtime_error(where + ": " + problem + "; " + remedy) {}
};

}  // namespace photopic
