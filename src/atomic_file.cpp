#include "atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <optional>
#include <string>
#include <system_error>

#include "error.h"

namespace photopic {
namespace {

namespace fs = std::filesystem;

std::error_code last_error() {
  return {errno, std::generic_category()};
}

/// The standard output or error that a path leads to, as /dev/stdout does. To open it anew would begin at the
/// start of a file it was sent to.
std::optional<int> standard_stream(const fs::path& file) {
  struct stat named {
  }, open{};
  if (::stat(file.c_str(), &named) != 0) return {};
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    if (::fstat(stream, &open) == 0 && open.st_dev == named.st_dev && open.st_ino == named.st_ino)
      return stream;
  return {};
}

/// A pipe or a device.
bool is_special(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

/// A new file for the time of writing, which nobody else uses: containers that share a folder may share
/// process ids, too.
struct Partial {
  fs::path path;
  int file = -1;
};

fs::path partial_name(const fs::path& target, int number) {
  constexpr std::size_t kLongest = 200;  // with what is added it stays within the 255 of most disks
  return folder_of(target) /
         ("." + target.stem().string().substr(0, kLongest) + "." + std::to_string(::getpid()) + "-" +
          std::to_string(number) + ".partial" + target.extension().string());
}

/// Its `file` is below 0, and errno says why, where none can be made.
Partial make_partial(const fs::path& target) {
  for (int number = 0;; ++number) {
    Partial partial{partial_name(target, number)};
    partial.file = ::open(partial.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (partial.file >= 0 || errno != EEXIST) return partial;
  }
}

std::error_code write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      return last_error();
  }
  return {};
}

/// Writes all of an opened file and closes it.
/// @return what failed, to open it too; some disks tell that they are full only when the file is closed
std::error_code write_to(int file, std::string_view bytes, std::optional<mode_t> permissions) {
  if (file < 0) return last_error();
  std::error_code failure = write_all(file, bytes);
  if (permissions && ::fchmod(file, *permissions) != 0 && !failure) failure = last_error();
  if (::close(file) != 0 && !failure) failure = last_error();
  return failure;
}

std::optional<mode_t> permissions_of(const fs::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return {};
  return found.st_mode & 07777u;
}

const char* remedy_of(const std::error_code& error) {
  switch (error.value()) {
    case ENOSPC:
    case EDQUOT:
      return "free space on the disk or choose another";
    case EFBIG:
      return "choose another disk or allow larger files (ulimit -f)";
    case EPIPE:
      return "what was to read it has ended: let it read all, or name a file";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose another folder or change its permissions";
    default:
      return "check the folder and its disk";
  }
}

[[noreturn]] void fail(const fs::path& file, const std::error_code& error) {
  throw InputError(file.string(), "cannot be written: " + error.message(), remedy_of(error));
}

void replace(const fs::path& file, std::string_view bytes) {
  const fs::path target = follow_links(file);
  const std::optional<mode_t> permissions = permissions_of(target);
  const Partial partial = make_partial(target);
  if (const std::error_code error = write_to(partial.file, bytes, permissions)) {
    if (partial.file >= 0) ::unlink(partial.path.c_str());
    fail(file, error);
  }
  std::error_code error;
  fs::rename(partial.path, target, error);
  if (error)
    throw InputError(file.string(), "cannot be replaced: " + error.message(),
                     "what was to be written is whole in " + partial.path.string());
}

/// Makes a file as replace() will, and removes it.
std::error_code try_folder(const fs::path& target) {
  struct stat ignored {};
  if (::lstat(target.c_str(), &ignored) != 0 && errno != ENOENT) return last_error();
  const Partial partial = make_partial(target);
  const std::error_code error = write_to(partial.file, "", {});
  if (partial.file >= 0) ::unlink(partial.path.c_str());
  return error;
}

}  // namespace

fs::path follow_links(fs::path file) {
  constexpr int kMaxLinks = 40;  // Linux's own bound
  std::error_code error;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(file, error); ++i)
    file = file.parent_path() / fs::read_symlink(file, error);
  return file;
}

void write_file(const fs::path& file, std::string_view bytes) {
  const std::optional<int> stream = standard_stream(file);
  if (!stream && !is_special(file)) return replace(file, bytes);
  std::fflush(nullptr);  // what was printed before comes before
  const auto write_special = [&] {
    return write_to(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666), bytes, {});
  };
  if (const std::error_code error = stream ? write_all(*stream, bytes) : write_special()) fail(file, error);
}

bool is_standard_output(const fs::path& file) {
  return standard_stream(file) == STDOUT_FILENO;
}

void check_writable_file(const fs::path& file) {
  std::error_code error;
  if (file == "-")
    throw InputError("-", "does not stand for standard output here", "name a file, or /dev/stdout");
  if (file.filename().empty() || fs::is_directory(file, error))
    throw InputError(file.string(), "is a folder", "name a file in it");
  if (standard_stream(file)) return;
  if (fs::exists(file, error) && ::access(file.c_str(), W_OK) != 0)
    throw InputError(file.string(), "cannot be written to", "choose another or change its permissions");
  if (is_special(file)) return;
  const fs::path target = follow_links(file), folder = folder_of(target);
  if (fs::is_symlink(target, error))
    throw InputError(file.string(), "is a symbolic link that leads back to itself", "name another file");
  if (!fs::is_directory(folder, error))
    throw InputError(file.string(), "there is no folder " + folder.string(), "make it first");
  if (const std::error_code failure = try_folder(target))
    throw InputError(file.string(),
                     "cannot be made in the folder " + folder.string() + ": " + failure.message(),
                     remedy_of(failure));
}

}  // namespace photopic
