#pragma once

#include <atomic>

namespace photopic {

/// Set by the first SIGINT (Ctrl-C) or SIGTERM after the first call of this function. The second ends the
/// process at once.
const std::atomic<bool>& interrupt_flag();

/// 128 + the signal, as shells have it: 130 after SIGINT, 143 after SIGTERM.
int interrupted_exit_code();

}  // namespace photopic
