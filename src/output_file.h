#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "atomic_file.h"

namespace photopic {

/// Checks that `folder` is a folder, or can be made in one that exists.
/// @throws InputError
void check_writable_folder(const std::filesystem::path& folder);

/// Checks that no output would take the place of an input or of another output, under whatever name. Empty
/// paths stand for what was not asked for; inputs that are no files ("cie:A") may be among them.
/// @throws InputError
void check_no_overwriting(const std::vector<std::filesystem::path>& outputs,
                          const std::vector<std::filesystem::path>& inputs);

/// Writes the file whole or not at all.
/// @throws InputError when that fails
void write_text_file(const std::filesystem::path& file, std::string_view text);

/// The same; bytes that are no UTF-8, of file names, become U+FFFD.
void write_json_file(const std::filesystem::path& file, const nlohmann::ordered_json& json);

}  // namespace photopic
