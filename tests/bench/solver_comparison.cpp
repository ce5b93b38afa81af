// NLopt's algorithms at the optimiser's task, from the same starts: what value they reach [ΔE] with the same
// number of evaluations, and in the same processor time.
//   solver_comparison [--starts N] [--evaluations N] [--seconds S] [LAMP…]
// Four wavelengths, 49 nodes each, 256 strata of u; one thread. `best` and `median` are over the starts,
// seconds and evaluations a start's.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
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
constexpr std::pair<Algorithm, const char*> kAlgorithms[] = {
    {Algorithm::lbfgs, "LBFGS"}, {Algorithm::var2, "VAR2"},   {Algorithm::tnewton, "TNEWTON"},
    {Algorithm::mma, "MMA"},     {Algorithm::ccsaq, "CCSAQ"}, {Algorithm::slsqp, "SLSQP"},
    {Algorithm::sbplx, "SBPLX"}};

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
  return std::make_shared<const EstimateLoss>(targets, base_density(lamp, 0.02, 0.3));
}

struct Reached {
  double best, median, seconds, evaluations;
};

/// All starts, one after the other.
Reached run(const std::shared_ptr<const EstimateLoss>& loss, const Request& request, DescentLimits limits) {
  const std::clock_t begin = std::clock();
  std::vector<double> values;
  double evaluations = 0.0;
  for (int i = 0; i < request.starts; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const Candidate start = random_candidate(kWavelengths, kNodes, random);
    ObjectiveFunction objective(loss, start.backwards, kNodes, kStrata);
    const Descent found =
        descend([&](std::span<const double> v, std::span<double> gradient) { return objective(v, gradient); },
                start.v, limits);
    values.push_back(found.value);
    evaluations += found.evaluations;
  }
  std::sort(values.begin(), values.end());
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return {values.front(), values[values.size() / 2], seconds / request.starts, evaluations / request.starts};
}

void print_lamp(const std::string& lamp, const Request& request) {
  const auto loss = loss_for(lamp);
  for (const auto& [algorithm, name] : kAlgorithms) {
    const Reached by_count = run(loss, request, {.evaluations = request.evaluations, .algorithm = algorithm});
    const Reached by_clock =
        run(loss, request, {.evaluations = 1 << 30, .seconds = request.seconds, .algorithm = algorithm});
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
