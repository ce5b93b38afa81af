#pragma once

#include <cctype>
#include <filesystem>
#include <string>

namespace photopic {

/// ".exr" of "a/b.EXR"; empty where there is none.
inline std::string lower_case_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

}  // namespace photopic
