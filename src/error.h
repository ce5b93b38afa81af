#pragma once

#include <stdexcept>
#include <string>

namespace photopic {

/// The text without control characters (line ends, terminals' escapes), which names from files may hold:
/// those of ASCII and, as UTF-8 writes them, U+0080 to U+009F.
inline std::string without_controls(std::string text) {
  unsigned char before = 0;
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 32 || byte == 127) c = ' ';
    if (before == 0xC2 && byte >= 0x80 && byte < 0xA0) *(&c - 1) = c = ' ';
    before = byte;
  }
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
