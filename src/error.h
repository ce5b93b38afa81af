#pragma once

#include <stdexcept>
#include <string>

namespace photopic {

/// The text without control characters (line ends, terminals' escapes), which names from files may hold.
inline std::string without_controls(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  return text;
}

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
