#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "error.h"
#include "output_file.h"

namespace photopic {
namespace {

/// What stderr got of a failure, and the exit code.
std::pair<std::string, int> told(const std::function<void()>& write) {
  OutputAttempts attempt;
  testing::internal::CaptureStderr();
  attempt("a.exr", write);
  return {testing::internal::GetCapturedStderr(), attempt.exit_code(130)};
}

TEST(OutputAttempts, WhateverFailsIsToldAndTheNextIsTried) {
  EXPECT_EQ(told([] {}), std::pair(std::string(), 130));
  EXPECT_EQ(told([] { throw InputError("b", "is full", "free space"); }),
            std::pair(std::string("photopic: b: is full; free space\n"), 1));
  EXPECT_EQ(told([] { throw std::bad_alloc(); }),
            std::pair(std::string("photopic: a.exr: cannot be written: out of memory; choose a smaller "
                                  "resolution or fewer layers\n"),
                      1));
  EXPECT_EQ(
      told([] { throw std::logic_error("odd"); }),
      std::pair(std::string("photopic: a.exr: cannot be written: internal error: odd; please report it\n"),
                2));
}

TEST(OutputAttempts, TheWorstFailureCounts) {
  OutputAttempts attempt;
  testing::internal::CaptureStderr();
  attempt("a.exr", [] { throw std::logic_error("odd"); });
  attempt("b.exr", [] { throw std::bad_alloc(); });
  bool tried = false;
  attempt("c.exr", [&] { tried = true; });
  testing::internal::GetCapturedStderr();
  EXPECT_TRUE(tried);
  EXPECT_EQ(attempt.exit_code(0), 2);
}

}  // namespace
}  // namespace photopic
