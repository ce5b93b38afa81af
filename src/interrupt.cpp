#include "interrupt.h"

#include <csignal>

#include "commands.h"

namespace photopic {
namespace {

// A signal handler reaches nothing but statics.
std::atomic<bool> interrupted{false};
std::atomic<int> last_signal{SIGINT};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void on_interrupt(int signal) {
  last_signal.store(signal);
  interrupted.store(true);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool install() {
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  return sigaction(SIGTERM, &action, nullptr) == 0 && sigaction(SIGINT, &action, nullptr) == 0;
}

}  // namespace

const std::atomic<bool>& interrupt_flag() {
  static const bool installed = install();
  static_cast<void>(installed);
  return interrupted;
}

int interrupted_exit_code() {
  return kExitSignal + last_signal.load();
}

}  // namespace photopic
