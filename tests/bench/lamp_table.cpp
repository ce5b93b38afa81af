// The table of all lamps: how far the mean of 64 paths lies from a colour's truth, sampler by sampler.
//   lamp_table REFLECTANCES.csv [--effort quick|default|thorough] [--wavelengths N] [--trials N] [LAMP…]
// REFLECTANCES.csv: a header line, then wavelength and one reflectance a column. Each number is the mean ΔE00
// of the mean of 64 independent paths over trials and reflectances; white D65, R = 1 has Y = 1.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "optimize/solver.h"
#include "spectral/color_difference.h"
#include "spectral/illuminants.h"
#include "spectral/observer.h"
#include "spectral/wavelength_sampler.h"

using namespace photopic;

namespace {

constexpr int kPaths = 64;
constexpr const char* kSamplers[] = {"uniform", "visible", "illuminant", "optimized"};

struct Request {
  std::string reflectances;
  std::vector<std::string> lamps;
  OptimizeOptions optimize;
  int trials = 256;
};

std::vector<std::string> all_lamps() {
  std::vector<std::string> names;
  for (int i = 1; i <= 12; ++i) names.push_back("FL" + std::to_string(i));
  for (int i = 1; i <= 5; ++i) names.push_back("HP" + std::to_string(i));
  for (const char* name : {"LED-B1", "LED-B2", "LED-B3", "LED-B4", "LED-B5", "LED-BH1", "LED-RGB1", "LED-V1",
                           "LED-V2", "A", "D65"})
    names.emplace_back(name);
  return names;
}

Request parse(int count, char** words) {
  Request request;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto value = [&] {
      if (++i == count) throw std::invalid_argument(word + " wants a value");
      return std::string(words[i]);
    };
    if (word == "--effort") {
      const std::string name = value();
      request.optimize.effort = name == "quick"      ? Effort::quick
                                : name == "thorough" ? Effort::thorough
                                                     : Effort::normal;
    } else if (word == "--wavelengths") {
      request.optimize.wavelengths = std::stoi(value());
    } else if (word == "--trials") {
      request.trials = std::stoi(value());
    } else if (request.reflectances.empty()) {
      request.reflectances = word;
    } else {
      request.lamps.push_back(word);
    }
  }
  if (request.reflectances.empty()) throw std::invalid_argument("give a file of reflectances");
  if (request.lamps.empty()) request.lamps = all_lamps();
  return request;
}

std::vector<TabulatedSpectrum> read_reflectances(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::invalid_argument(file + ": cannot be read");
  std::string line;
  std::getline(in, line);
  std::vector<double> lambda;
  std::vector<std::vector<double>> columns;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    lambda.push_back(std::stod(cell));
    for (std::size_t c = 0; std::getline(cells, cell, ','); ++c) {
      if (lambda.size() == 1) columns.emplace_back();
      columns.at(c).push_back(std::stod(cell));
    }
  }
  std::vector<TabulatedSpectrum> reflectances;
  for (std::vector<double>& column : columns)
    reflectances.emplace_back(lambda, std::move(column), Beyond::end_value);
  if (reflectances.empty()) throw std::invalid_argument(file + ": holds no reflectances");
  return reflectances;
}

/// A lamp of unit Y with the reflectances' true colours under it.
struct Scene {
  TabulatedSpectrum emission;
  std::vector<TabulatedSpectrum> reflectances;
  std::vector<Lab> exact;
};

Scene make_scene(const TabulatedSpectrum& lamp, const std::vector<TabulatedSpectrum>& reflectances) {
  Scene scene{lamp.scaled(1.0 / emission_xyz(lamp, Observer::cie1931()).y), reflectances, {}};
  for (const TabulatedSpectrum& reflectance : reflectances)
    scene.exact.push_back(xyz_to_lab(
        emission_xyz(tabulate_product(scene.emission, reflectance), Observer::cie1931()), d65_white()));
  return scene;
}

/// The mean ΔE of one trial; its random numbers are its own.
double trial_delta_e(const WavelengthSampler& sampler, const Scene& scene, int trial) {
  std::mt19937_64 random(static_cast<std::uint64_t>(trial));
  std::uniform_real_distribution<double> uniform;
  const auto count = static_cast<std::size_t>(wavelength_count(sampler));
  const double scale = 1.0 / (Observer::cie1931().y_integral() * kPaths);
  std::vector<double> lambda(count), density_sum(count);
  std::vector<Xyz> mean(scene.reflectances.size());
  for (int path = 0; path < kPaths; ++path) {
    draw_wavelengths(sampler, uniform(random), lambda, density_sum);
    for (std::size_t j = 0; j < count; ++j) {
      const Xyz white = Observer::cie1931()(lambda[j]) * (scale * scene.emission(lambda[j]) / density_sum[j]);
      for (std::size_t m = 0; m < mean.size(); ++m) mean[m] += white * scene.reflectances[m](lambda[j]);
    }
  }
  double sum = 0.0;
  for (std::size_t m = 0; m < mean.size(); ++m)
    sum += delta_e_2000(scene.exact[m], xyz_to_lab(mean[m], d65_white()));
  return sum / static_cast<double>(mean.size());
}

double mean_delta_e(const WavelengthSampler& sampler, const Scene& scene, int trials) {
  std::vector<double> values(static_cast<std::size_t>(trials));
  tbb::parallel_for(0, trials, [&](int i) { values[i] = trial_delta_e(sampler, scene, i); });
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / trials;
}

void print_summary(const char* title, std::vector<double> ratios) {
  std::sort(ratios.begin(), ratios.end());
  const std::size_t n = ratios.size();
  const double median = 0.5 * (ratios[(n - 1) / 2] + ratios[n / 2]);
  std::printf("optimized over %s: 1/%.2f in the median lamp, 1/%.2f in the worst\n", title, median,
              ratios.front());
}

void print_table(const Request& request) {
  const std::vector<TabulatedSpectrum> reflectances = read_reflectances(request.reflectances);
  const int count = request.optimize.wavelengths;
  std::printf("%-10s", "lamp");
  for (const char* name : kSamplers) std::printf("%12s", name);
  std::printf("%12s%12s%10s\n", "uniform/", "best/", "seconds");

  std::vector<double> over_uniform, over_best;
  for (const std::string& name : request.lamps) {
    const auto table = cie_illuminant(name);
    if (!table) throw std::invalid_argument(name + " is no CIE illuminant");
    const TabulatedSpectrum lamp = tabulate_emission(*table);
    const OptimizeResult made = optimize_distribution(std::span(&lamp, 1), request.optimize);
    const WavelengthSampler samplers[] = {UniformWavelengths{count}, VisibleWavelengths{count},
                                          IlluminantWavelengths{count, base_density(lamp)},
                                          OptimizedWavelengths(made.distribution)};
    const Scene scene = make_scene(lamp, reflectances);
    double value[4];
    for (int s = 0; s < 4; ++s) value[s] = mean_delta_e(samplers[s], scene, request.trials);
    over_uniform.push_back(value[0] / value[3]);
    over_best.push_back(std::min({value[0], value[1], value[2]}) / value[3]);
    std::printf("%-10s%12.3f%12.3f%12.3f%12.3f%12.2f%12.2f%10.2f\n", name.c_str(), value[0], value[1],
                value[2], value[3], over_uniform.back(), over_best.back(), made.seconds);
    std::fflush(stdout);
  }
  print_summary("uniform", over_uniform);
  print_summary("the best baseline", over_best);
}

}  // namespace

int main(int count, char** words) {
  try {
    print_table(parse(count, words));
    return EXIT_SUCCESS;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "lamp_table: %s\n", problem.what());
    return EXIT_FAILURE;
  }
}
