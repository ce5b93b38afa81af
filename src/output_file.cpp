#include "output_file.h"

#include <unistd.h>

#include <fstream>
#include <string>

#include "error.h"

namespace photopic {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void check_folder_takes_files(const fs::path& folder, const fs::path& output) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw InputError(output.string(), "there is no folder " + folder.string(), "make it first");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(output.string(), "the folder " + folder.string() + " cannot be written to",
                     "choose another or change its permissions");
}

}  // namespace

void check_writable_file(const fs::path& file) {
  std::error_code error;
  if (file.filename().empty() || fs::is_directory(file, error))
    throw InputError(file.string(), "is a folder", "name a file in it");
  check_folder_takes_files(folder_of(file), file);
}

void check_writable_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return check_folder_takes_files(folder, folder);
  if (fs::exists(folder, error)) throw InputError(folder.string(), "is not a folder", "name a folder");
  const fs::path plain = folder.has_filename() ? folder : folder.parent_path();
  check_folder_takes_files(folder_of(plain), folder);
}

fs::path temporary_name(const fs::path& file) {
  return folder_of(file) / ("." + file.filename().string() + "." + std::to_string(getpid()) + ".part");
}

void write_text_file(const fs::path& file, std::string_view text) {
  // Pipes and devices (/dev/stdout) are written to, not replaced.
  std::error_code error;
  const bool replace = !fs::exists(file, error) || fs::is_regular_file(file, error);
  const fs::path target = replace ? temporary_name(file) : file;
  std::ofstream stream(target, std::ios::binary);
  stream << text;
  stream.close();
  error.clear();
  if (stream && replace) fs::rename(target, file, error);
  if (!stream || error) {
    std::error_code ignored;
    if (replace) fs::remove(target, ignored);
    throw InputError(file.string(), "cannot be written",
                     "check the folder's permissions and the disk's free space");
  }
}

}  // namespace photopic
