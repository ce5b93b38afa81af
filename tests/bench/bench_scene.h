#pragma once

#include <memory>
#include <string>

#include "core/prepared_scene.h"
#include "integrator/integrator.h"

namespace photopic {

/// What a benchmark program renders, as its command line names it.
struct BenchRequest {
  std::string scene;    ///< a .gltf or .glb file
  std::string emitter;  ///< SPECTRUM of every emitter; empty: the scene's own
  int width = 0, height = 0;
  std::string sampler = "illuminant";  ///< or "uniform", "visible"
  int wavelengths = 4;
  int rounds = 5;  ///< alternating measurements, of which medians are printed
  RenderOptions render{.spp = 8, .max_depth = 65};
};

/// SCENE [--emitter SPECTRUM] [--resolution WxH] [--sampler NAME] [--wavelengths N] [--spp N] [--max-depth N]
/// [--rounds N]
/// @throws std::invalid_argument
BenchRequest parse_bench_request(int count, char** words);

/// A benchmark's main: its problems in one line on stderr. @return the exit code
int run_bench(const char* name, void (*run)(const BenchRequest&), int count, char** words);

std::unique_ptr<PreparedScene> load_bench_scene(const BenchRequest& request);

/// @throws std::invalid_argument when the sampler's name is not known
WavelengthSampler bench_sampler(const BenchRequest& request, const PreparedScene& scene);

/// CPU seconds of the process so far, all its threads together.
double process_cpu_seconds();
/// CPU seconds of the calling thread so far.
double thread_cpu_seconds();

/// @param values at least one
double median_of(std::vector<double> values);

}  // namespace photopic
