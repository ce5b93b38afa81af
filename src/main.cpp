#include <fcntl.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <thread>

#include "command_line.h"
#include "command_line_errors.h"
#include "commands.h"
#include "core/image_io.h"
#include "error.h"
#include "interrupt.h"
#include "messages.h"
#include "optimize/solver.h"

namespace photopic {
namespace {

int run(int argc, char** argv) {
  CLI::App app("A spectral path tracer that chooses its wavelengths to suit the lamps.", "photopic");
  app.set_version_flag("--version", "photopic " PHOTOPIC_VERSION);
  app.require_subcommand(1);
  std::function<int()> action;
  int threads = 0;
  bind_commands(app, action, threads);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return explain(app, error, {argv + 1, argv + argc});
  }
  const std::size_t all = std::max(1u, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  threads > 0 ? static_cast<std::size_t>(threads) : all);
  if (threads > 0) limit_image_threads(threads);
  return action();
}

/// @return the exit code
int run_guarded(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    print_error(error.what());
    return kExitBadInput;
  } catch (const SearchStopped&) {
    print_error("interrupted while optimising; nothing is written");
    return interrupted_exit_code();
  } catch (const std::bad_alloc&) {
    print_error("out of memory; choose a smaller scene or resolution, or fewer --spectral-bins");
    return kExitBadInput;
  } catch (const std::exception& error) {
    print_error(fmt::format("internal error: {}; please report it", error.what()));
  } catch (...) {
    print_error("internal error of unknown kind; please report it");
  }
  return kExitInternalError;
}

/// Where stderr was closed (`2>&-`) the next file opened would get its number, and what is told would go
/// there.
void keep_stderr_open() {
  if (::fcntl(STDERR_FILENO, F_GETFD) != -1) return;
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere < 0 || nowhere == STDERR_FILENO) return;
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

}  // namespace
}  // namespace photopic

int main(int argc, char** argv) {
  using namespace photopic;
  keep_stderr_open();
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond `ulimit -f` is an error like a full disk
  std::signal(SIGPIPE, SIG_IGN);  // so is a pipe whose reader has ended: it must not end a render
  const int code = run_guarded(argc, argv);
  return check_stdout() || code != kExitDone ? code : kExitBadInput;
}
