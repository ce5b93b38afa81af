#pragma once

#include <filesystem>
#include <string_view>

namespace photopic {

/// Where a path leads that may be a symbolic link, also one to what does not exist yet (the standard
/// library's canonical() wants it to).
std::filesystem::path follow_links(std::filesystem::path file);

/// Writes the file whole or not at all, the one way by which everything is written: under a temporary name in
/// its folder, then renamed. Symbolic links are followed and permissions kept, as a shell's redirection does;
/// pipes and devices are written to, and so is what standard output or error goes to, where that is.
/// @throws InputError when that fails; what was written but could not be renamed stays, and is named
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Whether a path leads to where standard output goes, as /dev/stdout does.
bool is_standard_output(const std::filesystem::path& file);

/// Checks before long work that `file` can be written: it is no folder and not protected, and a file can be
/// made in its folder.
/// @throws InputError
void check_writable_file(const std::filesystem::path& file);

}  // namespace photopic
