#include "interrupt.h"

#include <csignal>

namespace photopic {
namespace {

// A signal handler reaches nothing but statics.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_interrupt(int) {
  interrupted.store(true);
}

}  // namespace

const std::atomic<bool>& interrupt_flag() {
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  action.sa_flags = SA_RESETHAND;
  static const bool installed = sigaction(SIGINT, &action, nullptr) == 0;
  static_cast<void>(installed);
  return interrupted;
}

}  // namespace photopic
