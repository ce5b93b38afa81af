#include "interrupt.h"

#include <csignal>
#include <mutex>

#include "commands.h"

namespace photopic {
namespace {

// A signal handler reaches nothing but statics.
std::atomic<bool> interrupted{false};
std::atomic<int> last_signal{SIGINT};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

/// Not where the signal is ignored, as nohup leaves SIGHUP and a script's "&" SIGINT.
void handle(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) return;
  action = {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

void on_interrupt(int signal) {
  last_signal.store(signal);
  interrupted.store(true);
  handle(SIGHUP, SIG_IGN);  // a closed terminal sends it twice: by the kernel and by the shell
  handle(SIGTERM, SIG_DFL);
  handle(SIGINT, SIG_DFL);
}

void install() {
  for (int signal : {SIGHUP, SIGTERM, SIGINT}) handle(signal, on_interrupt);
}

}  // namespace

const std::atomic<bool>& interrupt_flag() {
  static std::once_flag installed;
  std::call_once(installed, install);
  return interrupted;
}

int interrupted_exit_code() {
  return kExitSignal + last_signal.load();
}

}  // namespace photopic
