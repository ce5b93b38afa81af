// Where a render's time goes, stage by stage: shares of the time and nanoseconds a path, medians of rounds on
// one thread, and what looking at the clock costs.
//   phases SCENE [--emitter SPECTRUM] [--resolution WxH] [--spp N] [--wavelengths N] [--sampler NAME] …
#include <tbb/global_control.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numeric>

#include "bench_scene.h"

using namespace photopic;

namespace {

constexpr std::array<const char*, kStages> kNames = {
    "between batches",     "camera, wavelengths", "intersect",     "emit",
    "sort by BSDF",        "shadow rays",         "film",          "shade diffuse",
    "shade opaque",        "shade conductor",     "shade layered", "shade glass",
    "shade spectral glass"};

/// Tells apart what the stages of one thread cost.
class StageClock : public StageWatch {
 public:
  /// The time since the last stage was this one's.
  void after(Stage stage) override {
    const double now = thread_cpu_seconds();
    seconds_[stage] += now - last_;
    last_ = now;
  }
  const std::array<double, kStages>& seconds() const { return seconds_; }

 private:
  std::array<double, kStages> seconds_{};
  double last_ = thread_cpu_seconds();
};

/// Of one render [s].
struct Round {
  double cpu;
  std::uint64_t paths;
};

Round render_round(const PreparedScene& scene, const WavelengthSampler& sampler, RenderOptions options,
                   StageClock* clock) {
  options.watch = clock;
  const double start = process_cpu_seconds();
  const RenderStats stats = render(scene, sampler, options).stats;
  return {process_cpu_seconds() - start, stats.paths};
}

void print_row(const char* name, double seconds, double all, std::uint64_t paths) {
  std::printf("%-21s %7.1f %9.1f\n", name, 100.0 * seconds / all, 1e9 * seconds / double(paths));
}

void run(const BenchRequest& request) {
  const auto scene = load_bench_scene(request);
  const WavelengthSampler sampler = bench_sampler(request, *scene);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);

  std::vector<double> plain, timed;
  std::array<std::vector<double>, kStages> stages;
  std::uint64_t paths = 0;
  for (int i = 0; i < request.rounds; ++i) {
    plain.push_back(render_round(*scene, sampler, request.render, nullptr).cpu);
    StageClock clock;
    const Round round = render_round(*scene, sampler, request.render, &clock);
    timed.push_back(round.cpu);
    paths = round.paths;
    for (std::size_t s = 0; s < kStages; ++s) stages[s].push_back(clock.seconds()[s]);
  }

  const double all = median_of(timed);
  std::printf("%-21s %7s %9s\n", "stage", "%", "ns a path");
  double told = 0.0;
  for (std::size_t s = 0; s < kStages; ++s) {
    const double seconds = median_of(stages[s]);
    if (seconds > 0.0) print_row(kNames[s], seconds, all, paths);
    told += seconds;
  }
  print_row("the rest", all - told, all, paths);
  print_row("all", all, all, paths);
  print_row("all, without a clock", median_of(plain), all, paths);
}

}  // namespace

int main(int count, char** words) {
  return run_bench("phases", run, count, words);
}
