#pragma once

#include <array>
#include <ctime>

#include "core/surface.h"

namespace photopic {

/// What a batch of paths goes through; from kStageShade on a stage for each BsdfKind, light sampling and
/// roulette included.
enum Stage : std::size_t {
  kStageStart,      ///< sample streams, wavelengths, camera rays
  kStageIntersect,  ///< nearest hits
  kStageEmit,       ///< light of lamps that were hit, absorption, the environment
  kStageSort,       ///< by BSDF
  kStageShadow,
  kStageFilm,
  kStageShade,
  kStages = kStageShade + kBsdfKinds
};

inline Stage shading_stage(BsdfKind kind) {
  return static_cast<Stage>(kStageShade + static_cast<std::size_t>(kind));
}

/// Told when a stage is done with the batch. Most renders have none.
class StageWatch {
 public:
  virtual ~StageWatch() = default;
  virtual void after(Stage stage) = 0;
};

/// Processor seconds of each Stage, of all threads together.
using StageSeconds = std::array<double, kStages>;

/// Tells apart what stages cost.
class StageClock : public StageWatch {
 public:
  explicit StageClock(StageSeconds& seconds) : seconds_(seconds) {}

  /// The time since the last stage was this one's.
  void after(Stage stage) override {
    const double time = now();
    seconds_[stage] += time - last_;
    last_ = time;
  }

 private:
  /// The thread's own: what others do on the machine does not count.
  static double now() {
    std::timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  StageSeconds& seconds_;
  double last_ = now();
};

}  // namespace photopic
