#pragma once

#include <atomic>

namespace photopic {

/// Set by the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (closed terminal) after the first call of this
/// function; those that the process was started to ignore stay ignored. A second SIGINT or SIGTERM ends it at
/// once.
const std::atomic<bool>& interrupt_flag();

/// 128 + the signal, as shells have it: 130 after SIGINT, 143 after SIGTERM, 129 after SIGHUP.
int interrupted_exit_code();

}  // namespace photopic
