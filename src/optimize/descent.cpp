#include "optimize/descent.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace photopic {
namespace {

constexpr unsigned kMemory = 20;  ///< steps that L-BFGS remembers; NLopt's own choice is hundreds, and slow

nlopt_algorithm nlopt_name(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::lbfgs:
      return NLOPT_LD_LBFGS;
    case Algorithm::mma:
      return NLOPT_LD_MMA;
    case Algorithm::ccsaq:
      return NLOPT_LD_CCSAQ;
    case Algorithm::slsqp:
      return NLOPT_LD_SLSQP;
    case Algorithm::var2:
      return NLOPT_LD_VAR2;
    case Algorithm::tnewton:
      return NLOPT_LD_TNEWTON_PRECOND_RESTART;
    case Algorithm::sbplx:
      return NLOPT_LN_SBPLX;
  }
  throw std::invalid_argument("no such algorithm");
}

/// What NLopt calls: remembers the best point, since NLopt may end anywhere and report a failure.
struct Watched {
  const Differentiable& function;
  const DescentLimits& limits;
  nlopt_opt solver;
  Descent& descent;
  std::clock_t begin = std::clock();
  bool stopped = false;
  std::exception_ptr thrown = {};

  double operator()(std::span<const double> v, std::span<double> gradient) {
    if (must_end()) return end();
    ++descent.evaluations;
    const double value = function(v, gradient);
    if (!std::isfinite(value)) return HUGE_VAL;
    if (value < descent.value) descent.value = value, descent.v.assign(v.begin(), v.end());
    return value;
  }
  bool must_end() const {
    if (limits.stop && limits.stop->load(std::memory_order_relaxed)) return true;
    return limits.seconds > 0.0 &&
           static_cast<double>(std::clock() - begin) > limits.seconds * CLOCKS_PER_SEC;
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
      nlopt_create(nlopt_name(limits.algorithm), static_cast<unsigned>(v.size())), nlopt_destroy);
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
