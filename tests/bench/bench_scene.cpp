#include "bench_scene.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>

#include "core/gltf_loader.h"

namespace photopic {

BenchRequest parse_bench_request(int count, char** words) {
  BenchRequest request;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto value = [&] {
      if (++i == count) throw std::invalid_argument(word + " wants a value");
      return std::string(words[i]);
    };
    if (word == "--emitter") {
      request.emitter = value();
    } else if (word == "--resolution") {
      if (std::sscanf(value().c_str(), "%dx%d", &request.width, &request.height) != 2)
        throw std::invalid_argument("--resolution is written as 640x480");
    } else if (word == "--sampler") {
      request.sampler = value();
    } else if (word == "--wavelengths") {
      request.wavelengths = std::stoi(value());
    } else if (word == "--spp") {
      request.render.spp = std::stoi(value());
    } else if (word == "--max-depth") {
      request.render.max_depth = std::stoi(value());
    } else if (word == "--rounds") {
      request.rounds = std::max(std::stoi(value()), 1);
    } else if (word.starts_with("--") || !request.scene.empty()) {
      throw std::invalid_argument(word + " is not known");
    } else {
      request.scene = word;
    }
  }
  if (request.scene.empty()) throw std::invalid_argument("give a scene");
  return request;
}

int run_bench(const char* name, void (*run)(const BenchRequest&), int count, char** words) {
  try {
    run(parse_bench_request(count, words));
    return EXIT_SUCCESS;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s: %s\n", name, problem.what());
    return EXIT_FAILURE;
  }
}

std::unique_ptr<PreparedScene> load_bench_scene(const BenchRequest& request) {
  GltfOptions options;
  if (!request.emitter.empty()) options.emitters.push_back({"", request.emitter});
  options.width = request.width, options.height = request.height;
  return std::make_unique<PreparedScene>(load_gltf(request.scene, options));
}

WavelengthSampler bench_sampler(const BenchRequest& request, const PreparedScene& scene) {
  if (request.sampler == "uniform") return UniformWavelengths{request.wavelengths};
  if (request.sampler == "visible") return VisibleWavelengths{request.wavelengths};
  if (request.sampler == "illuminant")
    return IlluminantWavelengths{request.wavelengths, base_density(scene_emission(scene))};
  throw std::invalid_argument(request.sampler + " is no sampler that needs no optimisation");
}

namespace {

double clock_seconds(clockid_t clock) {
  std::timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double process_cpu_seconds() {
  return clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

double thread_cpu_seconds() {
  return clock_seconds(CLOCK_THREAD_CPUTIME_ID);
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

}  // namespace photopic
