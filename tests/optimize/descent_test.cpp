#include "optimize/descent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace photopic {
namespace {

/// A bowl with its lowest point, 1, at (1, 2, …), which tells of every call.
struct Bowl {
  int calls = 0;
  double lowest_seen = std::numeric_limits<double>::infinity();

  double operator()(std::span<const double> v, std::span<double> gradient) {
    ++calls;
    double value = 1.0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double d = v[i] - static_cast<double>(i + 1), stiff = 1.0 + 9.0 * static_cast<double>(i);
      value += stiff * d * d;
      if (!gradient.empty()) gradient[i] = 2.0 * stiff * d;
    }
    lowest_seen = std::min(lowest_seen, value);
    return value;
  }
};

const std::vector<double> kStart{-3.0, 4.0, 0.5};

TEST(Descent, FindsTheLowestPointWithinItsBudget) {
  Bowl bowl;
  const Descent found = descend(std::ref(bowl), kStart, {.evaluations = 500, .tolerance = 1e-10});
  EXPECT_FALSE(found.failed) << found.note;
  EXPECT_NEAR(found.value, 1.0, 1e-4);
  EXPECT_EQ(found.value, bowl.lowest_seen);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found.v[i], static_cast<double>(i + 1), 0.01);
  EXPECT_EQ(found.evaluations, bowl.calls);
  EXPECT_LE(found.evaluations, 501);
}

TEST(Descent, StaysWithinItsBounds) {
  const auto slope = [](std::span<const double> v, std::span<double> gradient) {
    if (!gradient.empty()) gradient[0] = -1.0;
    return -v[0];
  };
  EXPECT_EQ(descend(slope, {100.0}, {.evaluations = 5}).v[0], kHighestUnknown);
  EXPECT_EQ(descend(slope, {0.0}, {.evaluations = 50}).v[0], kHighestUnknown);
}

// Wherever values stop being numbers, the best point met until then is what is left, and is told as a failure
// only where there was none.
TEST(Descent, KeepsTheBestPointWhenValuesBreakDown) {
  for (const int good : {1, 2, 3, 5}) {
    Bowl bowl;
    const auto breaking = [&](std::span<const double> v, std::span<double> gradient) {
      const double value = bowl.calls < good ? bowl(v, gradient) : std::nan("");
      return value;
    };
    const Descent found = descend(breaking, kStart, {.evaluations = 100, .tolerance = 1e-12});
    EXPECT_EQ(found.value, bowl.lowest_seen) << good;
    Bowl again;
    EXPECT_EQ(again(found.v, {}), found.value) << good;
    EXPECT_FALSE(found.note.empty());
  }
  const Descent none = descend([](auto, auto) { return std::nan(""); }, kStart, {.evaluations = 100});
  EXPECT_TRUE(none.failed);
  EXPECT_TRUE(std::isinf(none.value));
  EXPECT_EQ(none.v, kStart);
}

TEST(Descent, LetsExceptionsThrough) {
  Bowl bowl;
  const auto throwing = [&](std::span<const double> v, std::span<double> gradient) {
    if (bowl.calls == 3) throw std::domain_error("three is enough");
    return bowl(v, gradient);
  };
  EXPECT_THROW(descend(throwing, kStart, {.evaluations = 100}), std::domain_error);
}

TEST(Descent, StopsWhenItIsTold) {
  std::atomic<bool> stop = false;
  Bowl bowl;
  const auto stopping = [&](std::span<const double> v, std::span<double> gradient) {
    stop = bowl.calls == 2;
    return bowl(v, gradient);
  };
  const Descent found = descend(stopping, kStart, {.evaluations = 100, .tolerance = 1e-12, .stop = &stop});
  EXPECT_EQ(bowl.calls, 3);
  EXPECT_FALSE(found.failed);
  EXPECT_EQ(found.value, bowl.lowest_seen);
}

}  // namespace
}  // namespace photopic
