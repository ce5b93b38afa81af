#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
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

/// Writes all bytes to `path`, which is made or emptied.
/// @return what failed; some disks tell that they are full only when the file is closed
inline std::error_code write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  const auto last_error = [] { return std::error_code(errno, std::generic_category()); };
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return last_error();
  std::error_code failure;
  while (!bytes.empty() && !failure) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      failure = last_error();
  }
  if (::close(file) != 0 && !failure) failure = last_error();
  return failure;
}

/// Writes the file whole or not at all: the one way by which everything is written.
/// @throws InputError when that fails
inline void write_file(const std::filesystem::path& file, std::string_view bytes) {
  AtomicFile output(file);
  std::error_code error = write_bytes(output.partial(), bytes);
  if (!error) output.commit(error);
  if (error)
    throw InputError(file.string(), "cannot be written: " + error.message(),
                     "check the folder's permissions and the disk's free space");
}

/// Checks before long work that `file` can be written: it is no folder, and its folder exists and may be
/// written to.
/// @throws InputError
inline void check_writable_file(const std::filesystem::path& file) {
  std::error_code error;
  if (file == "-")
    throw InputError("-", "does not stand for standard output here", "name a file, or /dev/stdout");
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
