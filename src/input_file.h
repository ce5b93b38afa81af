#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "error.h"

namespace photopic {

/// Checks that `file` is a regular file that may be read: the libraries that read it tell less of why not.
/// @param where names it in messages
/// @throws InputError
inline void check_readable_file(const std::filesystem::path& file, const std::string& where) {
  using std::filesystem::file_type;
  const auto fail = [&](const std::string& problem, const char* remedy) {
    throw InputError(where, problem, remedy);
  };
  std::error_code error;
  const file_type type = std::filesystem::status(file, error).type();
  if (type == file_type::not_found) fail("there is no such file", "check its name and folder");
  if (type == file_type::none) fail("cannot be read: " + error.message(), "check its name and folder");
  if (type == file_type::directory) fail("is a folder", "name a file in it");
  if (type != file_type::regular)
    fail("is a pipe or device, not a file", "write what it gives to a file first");
  if (::access(file.c_str(), R_OK) != 0) fail("may not be read", "change its permissions or choose another");
}

inline void check_readable_file(const std::filesystem::path& file) {
  check_readable_file(file, file.string());
}

}  // namespace photopic
