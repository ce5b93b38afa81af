#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "atomic_file.h"

namespace photopic {

/// Checks that `folder` is a folder, or can be made in one that exists.
/// @throws InputError
void check_writable_folder(const std::filesystem::path& folder);

/// Whether the ending is .svg in either case.
bool is_svg(const std::filesystem::path& file);

/// Checks that `file` can be written, and that its ending says what it will be: an SVG drawing.
/// @throws InputError
void check_writable_plot(const std::filesystem::path& file);

/// Checks that no output would take the place of an input or of another output, under whatever name. Empty
/// paths stand for what was not asked for; inputs that are no files ("cie:A") may be among them.
/// @throws InputError
void check_no_overwriting(const std::vector<std::filesystem::path>& outputs,
                          const std::vector<std::filesystem::path>& inputs);

/// Whether a report is to be printed beside the JSON: not into it.
bool prints_report(bool quiet, const std::filesystem::path& json);

/// Writes the file whole or not at all; bytes that are no UTF-8, of file names, become U+FFFD.
/// @throws InputError when that fails
void write_json_file(const std::filesystem::path& file, const nlohmann::ordered_json& json);

/// Writes the results of long work one by one: what fails is told on stderr at once, and the others are
/// written all the same.
class OutputAttempts {
 public:
  /// @param output what is written, for messages
  void operator()(const std::filesystem::path& output, const std::function<void()>& write);
  int exit_code(int otherwise) const;  ///< that of the worst failure if there was one

 private:
  void fail(const std::string& why, int code);

  int code_ = 0;
};

}  // namespace photopic
