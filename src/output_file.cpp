#include "output_file.h"

#include <algorithm>
#include <new>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "error.h"
#include "file_ending.h"
#include "messages.h"

namespace photopic {
namespace {

namespace fs = std::filesystem;

/// Whether two names are of one regular file, or would be once it is written.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::exists(a, error) && !fs::is_regular_file(a, error)) return false;
  if (fs::equivalent(a, b, error)) return true;
  // A relative path of which nothing exists yet would stay relative.
  const fs::path first = fs::weakly_canonical(fs::absolute(follow_links(a), error), error);
  return !error && first == fs::weakly_canonical(fs::absolute(follow_links(b), error), error);
}

}  // namespace

void check_writable_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return check_writable_file(folder / "any");
  if (fs::exists(folder, error)) throw InputError(folder.string(), "is not a folder", "name a folder");
  const fs::path name = folder.has_filename() ? folder : folder.parent_path();
  if (fs::is_symlink(name, error))
    throw InputError(folder.string(), "is a symbolic link to no folder", "make that or name another");
  check_writable_file(name);
}

bool is_svg(const fs::path& file) {
  return lower_case_ending(file) == ".svg";
}

void check_writable_plot(const fs::path& file) {
  if (!is_svg(file)) throw InputError(file.string(), "the ending is not .svg", "name the plot so");
  check_writable_file(file);
}

void check_no_overwriting(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  std::error_code error;
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (output->empty()) continue;
    for (const fs::path& input : inputs)
      if (!input.empty() && fs::exists(input, error) && same_file(*output, input))
        throw InputError(output->string(), "is an input, too, and would be overwritten",
                         "name another file to write");
    for (auto other = outputs.begin(); other != output; ++other)
      if (!other->empty() && same_file(*output, *other))
        throw InputError(output->string(), "would be written twice", "give each output a name of its own");
  }
}

bool prints_report(bool quiet, const fs::path& json) {
  return !quiet && (json.empty() || !is_standard_output(json));
}

void write_json_file(const fs::path& file, const nlohmann::ordered_json& json) {
  write_file(file, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void OutputAttempts::operator()(const fs::path& output, const std::function<void()>& write) {
  const std::string what = output.string() + ": cannot be written: ";
  try {
    write();
  } catch (const InputError& error) {
    fail(error.what(), kExitBadInput);
  } catch (const fs::filesystem_error& error) {
    fail(
        error.path1().string() + ": cannot be written: " + error.code().message() + "; choose another folder",
        kExitBadInput);
  } catch (const std::bad_alloc&) {
    fail(what + "out of memory; choose a smaller resolution or fewer layers", kExitBadInput);
  } catch (const std::exception& error) {
    fail(what + "internal error: " + error.what() + "; please report it", kExitInternalError);
  }
}

void OutputAttempts::fail(const std::string& why, int code) {
  print_error(why);
  code_ = std::max(code_, code);
}

int OutputAttempts::exit_code(int otherwise) const {
  return code_ != 0 ? code_ : otherwise;
}

}  // namespace photopic
