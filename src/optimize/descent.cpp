#include "optimize/descent.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <new>

namespace photopic {
namespace {

constexpr unsigned kMemory = 20;  ///< steps remembered; NLopt's own choice is hundreds, and slow

/// What NLopt calls: remembers the best point, since NLopt may end anywhere and report a failure.
struct Watched {
  const Differentiable& function;
  const DescentLimits& limits;
  nlopt_opt solver;
  Descent& descent;
  bool stopped = false;
  std::exception_ptr thrown = {};

  double operator()(std::span<const double> v, std::span<double> gradient) {
    if (limits.stop && limits.stop->load(std::memory_order_relaxed)) return end();
    ++descent.evaluations;
    const double value = function(v, gradient);
    if (!std::isfinite(value)) return HUGE_VAL;
    if (value < descent.value) descent.value = value, descent.v.assign(v.begin(), v.end());
    return value;
  }
  double end() {
    stopped = true;
    nlopt_force_stop(solver);
    return HUGE_VAL;
  }

  /// NLopt is C: nothing may be thrown through it.
  static double call(unsigned count, const double* v, double* gradient, void* self) {
    Watched& watched = *static_cast<Watched*>(self);
    try {
      return watched({v, count}, {gradient, gradient ? count : 0});
    } catch (...) {
      watched.thrown = std::current_exception();
      return watched.end();
    }
  }
};

}  // namespace

Descent descend(const Differentiable& function, std::vector<double> v, const DescentLimits& limits) {
  for (double& x : v) x = std::clamp(x, kLowestUnknown, kHighestUnknown);
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> solver(
      nlopt_create(NLOPT_LD_LBFGS, static_cast<unsigned>(v.size())), nlopt_destroy);
  if (!solver) throw std::bad_alloc();

  Descent descent{.v = v, .value = std::numeric_limits<double>::infinity(), .note = {}};
  Watched watched{function, limits, solver.get(), descent};
  nlopt_set_min_objective(solver.get(), Watched::call, &watched);
  nlopt_set_lower_bounds1(solver.get(), kLowestUnknown);
  nlopt_set_upper_bounds1(solver.get(), kHighestUnknown);
  nlopt_set_maxeval(solver.get(), limits.evaluations);
  nlopt_set_vector_storage(solver.get(), kMemory);
  nlopt_set_ftol_rel(solver.get(), limits.tolerance);

  double value = 0.0;
  const nlopt_result result = nlopt_optimize(solver.get(), v.data(), &value);
  if (watched.thrown) std::rethrow_exception(watched.thrown);
  const bool normal = (result > 0 || result == NLOPT_ROUNDOFF_LIMITED) && std::isfinite(descent.value);
  descent.failed = !normal && !watched.stopped;
  descent.note = nlopt_result_to_string(result);
  return descent;
}

}  // namespace photopic
