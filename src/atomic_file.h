#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "error.h"

namespace photopic {

/// Where a path leads that may be a symbolic link, also one to what does not exist yet (the standard
/// library's canonical() wants it to).
inline std::filesystem::path follow_links(std::filesystem::path file) {
  constexpr int kMaxLinks = 40;  // Linux's own bound
  std::error_code error;
  for (int i = 0; i < kMaxLinks && std::filesystem::is_symlink(file, error); ++i)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  return file;
}

/// A file that appears whole or not at all: written under a temporary name in its folder, then renamed.
/// Symbolic links are followed, as a shell's redirection does; pipes and devices (/dev/stdout) are written
/// to, not replaced.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& file) : target_(file), partial_(file) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    direct_ = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
    if (direct_) return;
    target_ = follow_links(file);
    partial_ = folder() / ("." + target_.stem().string() + "." + std::to_string(::getpid()) + ".partial" +
                           file.extension().string());
  }
  ~AtomicFile() {
    std::error_code ignored;
    if (!direct_ && !done_) std::filesystem::remove(partial_, ignored);
  }
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// What to write to; it has the file's ending, and no other process uses it.
  const std::filesystem::path& partial() const { return partial_; }
  /// Where the temporary name stands.
  std::filesystem::path folder() const { return target_.has_parent_path() ? target_.parent_path() : "."; }
  /// Whether it is written to as it stands.
  bool direct() const { return direct_; }

  /// Puts what was written and closed in its place. Without this it is removed.
  void commit(std::error_code& error) {
    error.clear();
    if (!direct_) std::filesystem::rename(partial_, target_, error);
    done_ = !error;
  }

 private:
  std::filesystem::path target_, partial_;
  bool direct_ = false, done_ = false;
};

/// Checks before long work that `file` can be written: it is no folder, and its folder exists and may be
/// written to.
/// @throws InputError
inline void check_writable_file(const std::filesystem::path& file) {
  std::error_code error;
  if (file.filename().empty() || std::filesystem::is_directory(file, error))
    throw InputError(file.string(), "is a folder", "name a file in it");
  const AtomicFile output(file);
  if (output.direct()) {
    if (::access(file.c_str(), W_OK) != 0)
      throw InputError(file.string(), "cannot be written to", "choose another or change its permissions");
    return;
  }
  const std::filesystem::path folder = output.folder();
  if (std::filesystem::is_symlink(follow_links(file), error))
    throw InputError(file.string(), "is a symbolic link that leads back to itself", "name another file");
  if (!std::filesystem::is_directory(folder, error))
    throw InputError(file.string(), "there is no folder " + folder.string(), "make it first");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(file.string(), "the folder " + folder.string() + " cannot be written to",
                     "choose another or change its permissions");
}

}  // namespace photopic
