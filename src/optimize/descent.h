#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace photopic {

/// A function of v and its gradient (empty where it is not wanted).
using Differentiable = std::function<double(std::span<const double> v, std::span<double> gradient)>;

/// When a descent ends.
struct DescentLimits {
  int evaluations;                          ///< at most
  double tolerance = 0.0;                   ///< relative change of the value at which it ends; 0: never
  const std::atomic<bool>* stop = nullptr;  ///< once true, it ends before the next evaluation
};

/// Where a descent came to.
struct Descent {
  std::vector<double> v;  ///< the best point met, whatever NLopt ended with; within the bounds
  double value;           ///< there; infinite where no value was finite
  int evaluations = 0;
  bool failed = false;  ///< NLopt gave up
  std::string note;     ///< what it said
};

/// The bounds of each unknown.
inline constexpr double kLowestUnknown = -18.0, kHighestUnknown = 5.0;

/// Minimises by NLopt's L-BFGS (what others reach is in docs/optimiser.md) from v, which is brought within
/// the bounds first. A value that is not finite counts as infinite; what the function throws comes through.
Descent descend(const Differentiable& function, std::vector<double> v, const DescentLimits& limits);

}  // namespace photopic
