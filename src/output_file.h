#pragma once

#include <filesystem>
#include <string_view>

namespace photopic {

/// Checks before long work that `file` can be written: it is no folder and its folder exists and may be
/// written to.
/// @throws InputError
void check_writable_file(const std::filesystem::path& file);

/// Checks that `folder` is a folder, or can be made in one that exists.
/// @throws InputError
void check_writable_folder(const std::filesystem::path& folder);

/// Writes the file whole or not at all: to a temporary name in the same folder, then renamed.
/// @throws InputError when that fails
void write_text_file(const std::filesystem::path& file, std::string_view text);

/// A name beside `file` that no other process uses.
std::filesystem::path temporary_name(const std::filesystem::path& file);

}  // namespace photopic
