#pragma once

#include <atomic>

namespace photopic {

/// Set by the first SIGINT (Ctrl-C) after the first call of this function. The second SIGINT ends the process
/// at once.
const std::atomic<bool>& interrupt_flag();

}  // namespace photopic
