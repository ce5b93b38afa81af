// NLopt's algorithms at the optimiser's task, from the same starts: what value they reach [ΔE] with the same
// number of evaluations, and in the same processor time.
//   solver_comparison [--starts N] [--evaluations N] [--seconds S] [LAMP…]
// Four wavelengths, 49 nodes each, 256 strata of u; one thread. `best` and `median` are over the starts,
// seconds and evaluations a start's.
#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "optimize/candidate.h"
#include "optimize/descent.h"
#include "optimize/objective.h"
#include "optimize/reflectance_set.h"
#include "spectral/illuminants.h"
#include "spectral/wavelength_distribution.h"

using namespace photopic;

namespace {

constexpr int kWavelengths = 4, kNodes = 49, kStrata = 256;
constexpr std::pair<nlopt_algorithm, const char*> kAlgorithms[] = {
    {NLOPT_LD_LBFGS, "LBFGS"}, {NLOPT_LD_VAR2, "VAR2"},   {NLOPT_LD_TNEWTON_PRECOND_RESTART, "TNEWTON"},
    {NLOPT_LD_MMA, "MMA"},     {NLOPT_LD_CCSAQ, "CCSAQ"}, {NLOPT_LD_SLSQP, "SLSQP"},
    {NLOPT_LN_SBPLX, "SBPLX"}};
constexpr unsigned kMemory = 20;  ///< steps that L-BFGS remembers, as in descend()

struct Request {
  int starts = 16, evaluations = 600;
  double seconds = 0.3;
  std::vector<std::string> lamps;
};

Request parse(int count, char** words) {
  Request request;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto value = [&] {
      if (++i == count) throw std::invalid_argument(word + " wants a value");
      return std::string(words[i]);
    };
    if (word == "--starts") {
      request.starts = std::stoi(value());
    } else if (word == "--evaluations") {
      request.evaluations = std::stoi(value());
    } else if (word == "--seconds") {
      request.seconds = std::stod(value());
    } else if (word.starts_with("--")) {
      throw std::invalid_argument(word + " is not known");
    } else {
      request.lamps.push_back(word);
    }
  }
  if (request.lamps.empty()) request.lamps = {"FL11", "FL2", "HP1", "LED-B3", "A", "D65"};
  return request;
}

std::shared_ptr<const EstimateLoss> loss_for(const std::string& name) {
  const auto table = cie_illuminant(name);
  if (!table) throw std::invalid_argument(name + " is no CIE illuminant");
  const TabulatedSpectrum lamp = tabulate_emission(*table);
  const Targets targets{Objective::asymptotic, White::d65, lamp, {lamp}, target_reflectances(48, 1)};
  return std::make_shared<const EstimateLoss>(targets, base_density(lamp, kDefensiveShare, 0.3));
}

/// When an algorithm must end.
struct Budget {
  int evaluations;
  double seconds = 0.0;  ///< of processor time; 0: no clock
};

/// An objective as NLopt calls it, and the best that it has told.
struct Run {
  ObjectiveFunction& objective;
  nlopt_opt solver;
  double seconds;
  std::clock_t begin = std::clock();
  double best = HUGE_VAL;
  int evaluations = 0;

  static double call(unsigned count, const double* v, double* gradient, void* self) {
    Run& run = *static_cast<Run*>(self);
    if (run.seconds > 0.0 && static_cast<double>(std::clock() - run.begin) > run.seconds * CLOCKS_PER_SEC) {
      nlopt_force_stop(run.solver);
      return HUGE_VAL;
    }
    ++run.evaluations;
    const double value = run.objective({v, count}, {gradient, gradient ? count : 0});
    if (!std::isfinite(value)) return HUGE_VAL;
    run.best = std::min(run.best, value);
    return value;
  }
};

/// One start, whatever NLopt ends with. @param v where it begins
Run minimise(nlopt_algorithm algorithm, ObjectiveFunction& objective, std::vector<double> v, Budget budget) {
  for (double& x : v) x = std::clamp(x, kLowestUnknown, kHighestUnknown);
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> solver(
      nlopt_create(algorithm, static_cast<unsigned>(v.size())), nlopt_destroy);
  Run run{objective, solver.get(), budget.seconds};
  nlopt_set_min_objective(solver.get(), Run::call, &run);
  nlopt_set_lower_bounds1(solver.get(), kLowestUnknown);
  nlopt_set_upper_bounds1(solver.get(), kHighestUnknown);
  nlopt_set_maxeval(solver.get(), budget.evaluations);
  nlopt_set_vector_storage(solver.get(), kMemory);
  double value = 0.0;
  nlopt_optimize(solver.get(), v.data(), &value);
  return run;
}

struct Reached {
  double best, median, seconds, evaluations;
};

/// All starts, one after the other.
Reached run(const std::shared_ptr<const EstimateLoss>& loss, const Request& request,
            nlopt_algorithm algorithm, Budget budget) {
  const std::clock_t begin = std::clock();
  std::vector<double> values;
  double evaluations = 0.0;
  for (int i = 0; i < request.starts; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const Candidate start = random_candidate(kWavelengths, kNodes, random);
    ObjectiveFunction objective(loss, start.backwards, kNodes, kStrata);
    const Run found = minimise(algorithm, objective, start.v, budget);
    values.push_back(found.best);
    evaluations += found.evaluations;
  }
  std::sort(values.begin(), values.end());
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return {values.front(), values[values.size() / 2], seconds / request.starts, evaluations / request.starts};
}

void print_lamp(const std::string& lamp, const Request& request) {
  const auto loss = loss_for(lamp);
  for (const auto& [algorithm, name] : kAlgorithms) {
    const Reached by_count = run(loss, request, algorithm, {request.evaluations});
    const Reached by_clock = run(loss, request, algorithm, {1 << 30, request.seconds});
    std::printf("%-8s %-8s %9.2f %9.2f %9.3f %9.0f %9.2f %9.2f %9.3f %9.0f\n", lamp.c_str(), name,
                by_count.best, by_count.median, by_count.seconds, by_count.evaluations, by_clock.best,
                by_clock.median, by_clock.seconds, by_clock.evaluations);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int count, char** words) {
  try {
    const Request request = parse(count, words);
    std::printf("%-18s %39s %39s\n", "", "the same evaluations", "the same time");
    std::printf("%-8s %-8s", "lamp", "solver");
    for (int half = 0; half < 2; ++half)
      std::printf(" %9s %9s %9s %9s", "best", "median", "seconds", "evals");
    std::printf("\n");
    for (const std::string& lamp : request.lamps) print_lamp(lamp, request);
    return EXIT_SUCCESS;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "solver_comparison: %s\n", problem.what());
    return EXIT_FAILURE;
  }
}
